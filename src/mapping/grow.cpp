// SPDX-License-Identifier: Apache-2.0
#include "mapping/grow.hpp"

#include <algorithm>
#include <set>
#include <string>

#include "core/index.hpp"
#include "map/lookup.hpp"
#include "mapping/edges.hpp"
#include "mapping/edit_log.hpp"
#include "mapping/extra_places.hpp"
#include "mapping/growth_statistics.hpp"
#include "mapping/hypotheses.hpp"
#include "mapping/loops.hpp"
#include "mapping/new_places.hpp"
#include "mapping/old_places.hpp"
#include "mapping/place_sides.hpp"
#include "mapping/shortcut_edges.hpp"
#include "mapping/sights.hpp"
#include "mapping/subclusters.hpp"
#include "mapping/tour_path.hpp"

namespace homeward::mapping {
namespace {

/// The work on one growth, step by step.
class Growth {
 public:
  Growth(const map::TopologicalMap& old, const GrowthInput& input, const PairTable& pairs, const MappingConfig& config)
      : old_(old),
        input_(input),
        pairs_(pairs),
        config_(config),
        all_{input.images, input.tour_of, input.appearances, input.marks, &pairs, input.sweeps},
        fresh_{std::span(input.images).first(at(input.new_images)),
               std::span(input.tour_of).first(at(input.new_images)),
               std::span(input.appearances).first(at(input.new_images)),
               input.marks,
               &pairs,
               {}},
        path_(fresh_),
        track_(input.images, input.tour_of, pairs, path_.metric(), extent(), config.track),
        labels_(labels_by_image(all_)),
        old_places_(old, input, pairs, path_.metric(), config),
        sights_(all_) {
    for (int i = input.new_images; i < static_cast<int>(input.images.size()); ++i) {
      const std::string& label = old.places[at(input.anchored(i))].label;
      if (!label.empty()) labels_[at(i)] = &label;
    }
  }

  GrownMap run() {
    GrownMap grown{old_, {}};
    ++grown.map.revision;
    close();
    form_places();
    part_at_doorways();
    settle();
    put_in_extra_places();
    part_at_doorways();
    reject_across(loops_.hypotheses, loops_.parts, place_of_image_);
    add_places(grown);
    add_edges(grown);
    settle_shortcuts(grown.map);
    add_destinations(grown);
    add_hypotheses(grown);
    const UsualDistances usual = usual_distances(fresh_, path_, config_);
    grown.map.motion = grown_statistics(old_, grown.map, input_, pairs_, place_of_image_, usual);
    return grown;
  }

 private:
  [[nodiscard]] double extent() const { return path_.metric() ? config_.place_extent_m : config_.place_extent_images; }

  void close() {
    const float threshold = place_distance_threshold(fresh_, path_, config_);
    loops_ = close_loops(all_, config_, track_, labels_, threshold, nullptr, &old_places_);
  }

  [[nodiscard]] bool is_old(int part) const { return old_places_.is_old(loops_.parts[at(part)].prototype); }
  [[nodiscard]] int old_place(int part) const { return old_places_.place(loops_.parts[at(part)].prototype); }

  /// The place of each image: old ones and, behind them, new ones, which go to `places` after a stand-in for each old
  /// one.
  void form_places() {
    for (const map::Place& place : old_.places) {
      map::Place stand_in;
      stand_in.id = place.id;
      stand_in.prototype = place.prototype;
      places_.push_back(std::move(stand_in));
    }
    const std::vector<int>& group_of = loops_.place_of_part;
    const int groups = group_of.empty() ? 0 : *std::ranges::max_element(group_of) + 1;
    std::vector<std::vector<int>> images(at(groups));  // new ones of each group
    std::vector<int> place_of_group(at(groups), -1);
    for (std::size_t part = 0; part < loops_.parts.size(); ++part) {
      const auto group = at(group_of[part]);
      const std::vector<int>& own = loops_.parts[part].images;
      if (is_old(static_cast<int>(part))) {
        place_of_group[group] = old_place(static_cast<int>(part));
      } else {
        images[group].insert(images[group].end(), own.begin(), own.end());
      }
    }
    place_of_image_.assign(input_.images.size(), -1);
    for (std::size_t group = 0; group < images.size(); ++group) {
      if (images[group].empty()) continue;
      std::ranges::sort(images[group]);
      int& place = place_of_group[group];
      if (place < 0) {
        place = static_cast<int>(places_.size());
        places_.push_back(new_place(all_, images[group], labels_, places_.size()));
      }
      for (const int image : images[group]) place_of_image_[at(image)] = place;
    }
    for (int i = input_.new_images; i < static_cast<int>(input_.images.size()); ++i) {
      place_of_image_[at(i)] = input_.anchored(i);
    }
  }

  void part_at_doorways() {
    split_at_doorways(all_, config_.doorways, labels_, {}, input_.new_images, places_, place_of_image_);
  }

  /// New images as places of their own where an edge that the new tours make would be weak.
  void put_in_extra_places() {
    const std::vector<int> pinned = pinned_images(all_, loops_.parts);
    insert_extra_places(all_, config_, pinned, sights_, places_, place_of_image_, [this](int a, int b) {
      return settled_.contains({places_[at(a)].id, places_[at(b)].id});
    });
  }

  void add_places(GrownMap& grown) {
    map::TopologicalMap& map = grown.map;
    map.images.insert(map.images.end(), fresh_.images.begin(), fresh_.images.end());
    grown.added.images = input_.new_images;
    std::vector<std::vector<int>> images(places_.size());  // new ones of each place
    for (int i = 0; i < input_.new_images; ++i) images[at(place_of_image_[at(i)])].push_back(i);
    for (std::size_t p = 0; p < places_.size(); ++p) {
      if (p < old_.places.size()) {
        if (images[p].empty()) continue;
        join(map.places[p], images[p]);
        ++grown.added.joined_places;
        grown.added.joined_images += static_cast<int>(images[p].size());
        continue;
      }
      places_[p].id = PlaceId("p" + std::to_string(map.next_place_number++));
      places_[p].members.clear();
      for (const int image : images[p]) places_[p].members.push_back(input_.images[at(image)].id);
      map.places.push_back(std::move(places_[p]));
      ++grown.added.places;
      ++grown.added.appearances;
    }
  }

  void join(map::Place& place, const std::vector<int>& images) const {
    for (const int image : images) place.members.push_back(input_.images[at(image)].id);
    const int marked = first_labelled(images, labels_);
    if (place.label.empty() && marked >= 0) place.label = *labels_[at(marked)];
  }

  /// Edges that are there already, or that a person took away.
  void settle() {
    for (const map::Edge& edge : old_.edges) {
      if (!edge.shortcut) settled_.emplace(edge.from, edge.to);
    }
    for (const map::Edit& edit : old_.edits) {
      if (edit.kind != map::EditKind::kRemoveEdge || edit.undone) continue;
      const map::Place* a = map::find_place_of(old_, edit.image_a);
      const map::Place* b = map::find_place_of(old_, edit.image_b);
      if (a == nullptr || b == nullptr) continue;
      settled_.emplace(a->id, b->id);
      settled_.emplace(b->id, a->id);
    }
  }

  void add_edges(GrownMap& grown) {
    map::TopologicalMap& map = grown.map;
    for (map::Edge& edge : form_edges(all_, path_, track_, config_, map.places, place_of_image_, sights_)) {
      if (settled_.contains({edge.from, edge.to})) continue;
      map.edges.push_back(std::move(edge));
      ++grown.added.edges;
    }
  }

  void add_destinations(GrownMap& grown) const {
    map::TopologicalMap& map = grown.map;
    std::set<std::pair<PlaceId, std::string>> known;
    for (const map::Destination& destination : map.destinations) known.emplace(destination.place, destination.label);
    for (const MarkedImage& mark : input_.marks) {
      const PlaceId& place = map.places[at(place_of_image_[at(mark.image)])].id;
      if (!known.emplace(place, mark.label).second) continue;
      map.destinations.push_back({DestinationId("d" + std::to_string(map.next_destination_number++)), place,
                                  input_.images[at(mark.image)].id, mark.label, input_.appearances[at(mark.image)]});
      ++grown.added.destinations;
    }
  }

  void add_hypotheses(GrownMap& grown) const {
    for (const LoopHypothesis& hypothesis : loops_.hypotheses) {
      // The older image first.
      const int first = is_old(hypothesis.b) ? hypothesis.b : hypothesis.a;
      const int second = is_old(hypothesis.b) ? hypothesis.a : hypothesis.b;
      grown.map.hypotheses.push_back(kept_hypothesis(hypothesis,
                                                     input_.images[at(loops_.parts[at(first)].prototype)].id,
                                                     input_.images[at(loops_.parts[at(second)].prototype)].id));
    }
    grown.added.hypotheses = static_cast<int>(loops_.hypotheses.size());
  }

  const map::TopologicalMap& old_;
  const GrowthInput& input_;
  const PairTable& pairs_;
  const MappingConfig& config_;
  MappingInput all_;    // new images and anchors
  MappingInput fresh_;  // new images alone
  TourPath path_;
  TourTrack track_;
  ImageLabels labels_;
  OldPlaces old_places_;
  Sights sights_;
  ClosedLoops loops_;
  std::set<std::pair<PlaceId, PlaceId>> settled_;
  std::vector<map::Place> places_;
  std::vector<int> place_of_image_;
};

}  // namespace

GrownMap grow_map(const map::TopologicalMap& old, const GrowthInput& input, const PairTable& pairs,
                  const MappingConfig& config) {
  GrownMap grown = Growth(old, input, pairs, config).run();
  carry_over(old, grown.map);
  return grown;
}

}  // namespace homeward::mapping
