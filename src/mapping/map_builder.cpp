// SPDX-License-Identifier: Apache-2.0
#include "mapping/map_builder.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/index.hpp"
#include "map/graph.hpp"
#include "map/lookup.hpp"
#include "mapping/edges.hpp"
#include "mapping/edit_log.hpp"
#include "mapping/extra_places.hpp"
#include "mapping/hypotheses.hpp"
#include "mapping/identity.hpp"
#include "mapping/loops.hpp"
#include "mapping/new_places.hpp"
#include "mapping/place_sides.hpp"
#include "mapping/shortcut_edges.hpp"
#include "mapping/similarity.hpp"
#include "mapping/subclusters.hpp"
#include "mapping/tour_path.hpp"

namespace homeward::mapping {
namespace {

/// Places from subclusters, with their members.
std::vector<map::Place> form_places(const MappingInput& input, std::span<const Subcluster> subclusters,
                                    std::span<const int> place_of_subcluster, const ImageLabels& labels) {
  const int count = place_of_subcluster.empty() ? 0 : *std::ranges::max_element(place_of_subcluster) + 1;
  std::vector<std::vector<int>> images(at(count));
  for (std::size_t s = 0; s < subclusters.size(); ++s) {
    auto& members = images[at(place_of_subcluster[s])];
    members.insert(members.end(), subclusters[s].images.begin(), subclusters[s].images.end());
  }
  std::vector<map::Place> places;
  for (const std::vector<int>& members : images) {
    map::Place place = new_place(input, members, labels, places.size());
    for (const int image : members) place.members.push_back(input.images[at(image)].id);
    places.push_back(std::move(place));
  }
  return places;
}

std::vector<map::Destination> form_destinations(const MappingInput& input, std::span<const map::Place> places,
                                                std::span<const int> place_of_image) {
  std::vector<map::Destination> destinations;
  std::set<std::pair<int, std::string>> known;
  for (const MarkedImage& mark : input.marks) {
    // Marked again on the way back: one destination is enough where it is one place.
    if (!known.emplace(place_of_image[at(mark.image)], mark.label).second) continue;
    map::Destination destination;
    destination.place = places[at(place_of_image[at(mark.image)])].id;
    destination.image = input.images[at(mark.image)].id;
    destination.label = mark.label;
    destination.appearance = input.appearances[at(mark.image)];
    destinations.push_back(std::move(destination));
  }
  return destinations;
}

/// Of each place whether a person has said that two parts of it are one.
std::vector<char> joined_by_people(std::span<const LoopHypothesis> hypotheses, std::span<const int> place_of_part,
                                   std::size_t places) {
  std::vector<char> joined(places, 0);
  for (const LoopHypothesis& hypothesis : hypotheses) {
    if (hypothesis.by == map::Decider::kPerson && hypothesis.decision == map::Decision::kAccepted)
      joined[at(place_of_part[at(hypothesis.a)])] = 1;
  }
  return joined;
}

map::MotionStatistics measure_statistics(const MappingInput& input, const map::TopologicalMap& map,
                                         std::span<const int> place_of_image, const UsualDistances& usual) {
  map::MotionStatistics statistics;
  const map::PlaceGraph graph(map);
  double hops_squared = 0.0;
  int hops = 0;
  for (std::size_t i = 1; i < place_of_image.size(); ++i) {
    if (input.tour_of[i] != input.tour_of[i - 1]) continue;
    hops_squared += place_of_image[i] == place_of_image[i - 1] ? 0.0 : 1.0;
    ++hops;
  }
  if (hops > 0) statistics.hop_spread = std::max(0.5, std::sqrt(hops_squared / hops));

  const auto index = map::image_indices(map);
  std::vector<float> within;
  for (const map::Place& place : map.places) {
    const int prototype = index.at(place.prototype);
    for (const ImageId& member : place.members) {
      if (member == place.prototype) continue;
      within.push_back(input.pairs->distance(prototype, index.at(member)));
    }
  }
  std::erase_if(within, [](float distance) { return !std::isfinite(distance); });
  double squared = 0.0;
  for (const float distance : within) squared += static_cast<double>(distance) * static_cast<double>(distance);
  if (!within.empty()) {
    statistics.distance_spread = std::max(1e-3, std::sqrt(squared / static_cast<double>(within.size())));
  }
  if (!usual.empty()) statistics.distance_scale = std::max(1e-3, static_cast<double>(usual.quantile(0.5)));
  return statistics;
}

}  // namespace

map::TopologicalMap make_map(const MappingInput& input, const MappingConfig& config,
                             const map::TopologicalMap* previous) {
  return make_noted_map(input, config, previous).map;
}

NotedMap make_noted_map(const MappingInput& input, const MappingConfig& config, const map::TopologicalMap* previous) {
  const int images = static_cast<int>(input.images.size());
  const TourPath path(input);
  const ImageLabels labels = labels_by_image(input);
  const TourTrack track(input.images, input.tour_of, *input.pairs, path.metric(),
                        path.metric() ? config.place_extent_m : config.place_extent_images, config.track);
  const float threshold = place_distance_threshold(input, path, config);
  const UsualDistances usual = usual_distances(input, path, config);
  auto [cluster_of, parts, hypotheses, place_of_part] = close_loops(input, config, track, labels, threshold, previous);

  std::vector<int> place_of_image(at(images), 0);
  for (std::size_t part = 0; part < parts.size(); ++part) {
    for (const int image : parts[part].images) place_of_image[at(image)] = place_of_part[part];
  }
  map::TopologicalMap map;
  map.images.assign(input.images.begin(), input.images.end());
  map.places = form_places(input, parts, place_of_part, labels);
  const std::vector<char> stays = joined_by_people(hypotheses, place_of_part, map.places.size());
  split_at_doorways(input, config.doorways, labels, stays, images, map.places, place_of_image);
  Sights sights(input);
  const ExtraPlaces extra =
      insert_extra_places(input, config, pinned_images(input, parts), sights, map.places, place_of_image);
  // What was put in drew images to it from both sides.
  split_at_doorways(input, config.doorways, labels, stays, images, map.places, place_of_image);
  reject_across(hypotheses, parts, place_of_image);
  map.edges = form_edges(input, path, track, config, map.places, place_of_image, sights);
  map.destinations = form_destinations(input, map.places, place_of_image);
  MappingNotes notes{config, threshold, cluster_of, {}, {}, {}, {}, {}, extra.weak_before, extra.weak_after};
  for (const int image : extra.prototypes) notes.extra.push_back(input.images[at(image)].id);
  for (const LoopHypothesis& hypothesis : hypotheses) {
    notes.way.push_back(hypothesis.way.verdict);
    notes.taken_back.push_back(hypothesis.taken_back ? 1 : 0);
    notes.meets.push_back(hypothesis.meets ? 1 : 0);
    notes.reliability.push_back(hypothesis.reliability);
    map.hypotheses.push_back(kept_hypothesis(hypothesis, input.images[at(parts[at(hypothesis.a)].prototype)].id,
                                             input.images[at(parts[at(hypothesis.b)].prototype)].id));
  }
  map.motion = measure_statistics(input, map, place_of_image, usual);
  keep_identity(map, previous);
  if (previous != nullptr) {
    map.revision = previous->revision + 1;
    map.shortcuts = previous->shortcuts;
    std::erase_if(map.shortcuts, [](const map::Shortcut& one) { return one.state == map::ShortcutState::kProposed; });
    settle_shortcuts(map);
    const auto index = map::image_indices(map);
    const LookAt look = [&](const ImageId& image) -> Result<features::Appearance> {
      const auto found = index.find(image);
      if (found == index.end()) return fail(ErrorCode::kNotFound, "The tours do not have it.", image.str());
      return input.appearances[at(found->second)];
    };
    replay_edits(map, previous->edits, true, look);
  }
  return {std::move(map), std::move(notes)};
}

}  // namespace homeward::mapping
