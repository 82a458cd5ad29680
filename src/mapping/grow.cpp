// SPDX-License-Identifier: Apache-2.0
#include "mapping/grow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <unordered_map>

#include "map/lookup.hpp"
#include "map/parts.hpp"
#include "mapping/clustering.hpp"
#include "mapping/dempster_shafer.hpp"
#include "mapping/edges.hpp"
#include "mapping/subclusters.hpp"
#include "mapping/two_ways.hpp"

namespace homeward::mapping {
namespace {

constexpr double kToursApartImages = 1e6;  // so far apart along the way are images of different tours

std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// Where each image lies along the tours, in images.
std::vector<double> positions(const map::TopologicalMap& old, const GrowthInput& input) {
  std::unordered_map<std::string, int> tours;
  std::unordered_map<ImageId, double> old_positions;
  for (std::size_t i = 0; i < old.images.size(); ++i) {
    const int tour = tours.try_emplace(map::tour_of(old.images[i].id), static_cast<int>(tours.size())).first->second;
    old_positions.emplace(old.images[i].id, static_cast<double>(i) + kToursApartImages * tour);
  }
  std::vector<double> result;
  for (int i = 0; i < static_cast<int>(input.images.size()); ++i) {
    const double tour = static_cast<double>(tours.size()) + input.tour_of[at(i)];
    const auto known = old_positions.find(input.images[at(i)].id);
    const bool on_old_tour = input.is_anchor(i) && known != old_positions.end();
    result.push_back(on_old_tour ? known->second : static_cast<double>(i) + kToursApartImages * tour);
  }
  return result;
}

/// How far looks were right in the old map where the way could tell, as weigh_way() has it: its hypotheses keep that in
/// their masses before neighbours spoke.
double old_reliability(const map::TopologicalMap& old, const HypothesisConfig& config) {
  constexpr double kRounding = 1e-6;
  double agreed = 0.0;
  double contradicted = 0.0;
  for (const map::Hypothesis& hypothesis : old.hypotheses) {
    if (hypothesis.masses_before.is_false > config.contradicting_way_mass - kRounding) {
      contradicted += hypothesis.similarity;
    } else if (hypothesis.masses_before.is_true > config.own_weight * hypothesis.similarity + kRounding) {
      agreed += hypothesis.similarity;
    }
  }
  const double decided = agreed + contradicted;
  return std::max(0.0, config.looks_trusted + agreed - contradicted) / (config.looks_trusted + decided);
}

/// The work on one growth, step by step.
class Growth {
 public:
  Growth(const map::TopologicalMap& old, const GrowthInput& input, const PairTable& pairs, const MappingConfig& config)
      : old_(old),
        input_(input),
        pairs_(pairs),
        config_(config),
        all_{input.images, input.tour_of, input.appearances, input.marks, &pairs},
        fresh_{std::span(input.images).first(at(input.new_images)),
               std::span(input.tour_of).first(at(input.new_images)),
               std::span(input.appearances).first(at(input.new_images)), input.marks, &pairs},
        path_(fresh_),
        track_(input.images, input.tour_of, pairs, path_.metric(), extent(), config.track),
        labels_(input.images.size(), nullptr) {
    for (const MarkedImage& mark : input.marks) labels_[at(mark.image)] = &mark.label;
    for (int i = input.new_images; i < static_cast<int>(input.images.size()); ++i) {
      const std::string& label = old.places[at(input.anchored(i))].label;
      if (!label.empty()) labels_[at(i)] = &label;
    }
  }

  GrownMap run() {
    GrownMap grown{old_, {}};
    ++grown.map.revision;
    cluster();
    decide();
    add_places(grown);
    add_edges(grown);
    add_destinations(grown);
    add_hypotheses(grown);
    return grown;
  }

 private:
  [[nodiscard]] double extent() const { return path_.metric() ? config_.place_extent_m : config_.place_extent_images; }

  /// Two names are two places.
  [[nodiscard]] bool named_apart(int a, int b) const {
    return labels_[at(a)] != nullptr && labels_[at(b)] != nullptr && *labels_[at(a)] != *labels_[at(b)];
  }

  void cluster() {
    const DistanceFunction distance = [this](int a, int b) {
      const float visual = pairs_.distance(a, b);
      if (!std::isfinite(visual) || named_apart(a, b)) return std::numeric_limits<float>::infinity();
      const bool excluded =
          !input_.is_anchor(a) && !input_.is_anchor(b) && track_.judge(a, b).verdict == TrackVerdict::kContradicts;
      return excluded ? std::numeric_limits<float>::infinity() : visual;
    };
    NearLists near(input_.images.size());
    for (int a = 0; a < pairs_.images(); ++a) {
      for (const int b : pairs_.partners(a)) near[at(a)].push_back({b, distance(std::min(a, b), std::max(a, b))});
    }
    const std::vector<int> cluster_of =
        complete_linkage(std::move(near), place_distance_threshold(fresh_, path_, config_));
    std::vector<int> marked;
    for (const MarkedImage& mark : input_.marks) marked.push_back(mark.image);
    parts_ = subclusters(cluster_of, input_.tour_of, marked, distance);
  }

  [[nodiscard]] bool is_old(int part) const { return input_.is_anchor(parts_[at(part)].prototype); }
  [[nodiscard]] int old_place(int part) const { return input_.anchored(parts_[at(part)].prototype); }

  /// Factor on the reliability of looks for each hypothesis between old and new; 1 for the others.
  [[nodiscard]] std::vector<double> trust_between() const {
    const auto old_images = map::image_indices(old_);
    std::vector<Meeting> meetings;
    std::vector<std::size_t> hypothesis_of;
    for (std::size_t h = 0; h < hypotheses_.size(); ++h) {
      if (is_old(hypotheses_[h].a) == is_old(hypotheses_[h].b)) continue;
      const int image = parts_[at(hypotheses_[h].a)].prototype;  // the new one: anchors come last
      const int anchor = parts_[at(hypotheses_[h].b)].prototype;
      const auto old_image = old_images.find(input_.images[at(anchor)].id);
      meetings.push_back(
          {image, old_image == old_images.end() ? -1 : old_image->second, pairs_.relation(image, anchor)});
      hypothesis_of.push_back(h);
    }
    std::vector<double> trust(hypotheses_.size(), 1.0);
    const double on_old_tours = old_reliability(old_, config_.hypotheses);
    for (const std::size_t h : hypothesis_of) trust[h] = on_old_tours;
    const bool old_metric =
        std::ranges::all_of(old_.images, [](const map::MapImage& i) { return i.odometry.has_value(); });
    if (!old_metric || !path_.metric()) return trust;
    std::vector<int> old_tour_of;
    for (std::size_t i = 0; i < old_.images.size(); ++i) {
      const bool goes_on = i > 0 && map::tour_of(old_.images[i].id) == map::tour_of(old_.images[i - 1].id);
      old_tour_of.push_back(i == 0 ? 0 : old_tour_of.back() + (goes_on ? 0 : 1));
    }
    const PairTable unknown(static_cast<int>(old_.images.size()));  // the map keeps lengths and turns of odometry only
    const TourTrack old_way(old_.images, old_tour_of, unknown, true, extent(), config_.track);
    constexpr int kReach = 60;  // new images; further away odometry alone knows too little
    const std::vector<MeetingTrust> ways = meeting_trust(meetings, track_, old_way, extent(), kReach);
    // Borne out by several, looks need no other surety: alike rooms of a building lie in different places.
    constexpr double kBorneOut = 3.0;
    for (std::size_t m = 0; m < meetings.size(); ++m) {
      double& factor = trust[hypothesis_of[m]];
      factor = (ways[m].agreed >= kBorneOut ? 1.0 : factor) * ways[m].factor();
    }
    return trust;
  }

  void decide() {
    const UsualDistances usual = usual_distances(fresh_, path_, config_);
    const auto similarity = [&](int a, int b) {
      return usual.share_at_least(pairs_.distance(parts_[at(a)].prototype, parts_[at(b)].prototype));
    };
    hypotheses_ = formulate_hypotheses(parts_, similarity, config_.hypotheses);
    const auto way = [&](int a, int b) {
      return is_old(a) || is_old(b) ? WayEvidence{} : track_.judge(parts_[at(a)].prototype, parts_[at(b)].prototype);
    };
    weigh_way(hypotheses_, way, config_.hypotheses);
    const std::vector<double> trust = trust_between();
    for (std::size_t h = 0; h < hypotheses_.size(); ++h) {
      LoopHypothesis& hypothesis = hypotheses_[h];
      if (is_old(hypothesis.a) == is_old(hypothesis.b)) continue;
      hypothesis.reliability *= trust[h];
      hypothesis.before = evidence(hypothesis.similarity, config_.hypotheses.own_weight * hypothesis.reliability);
      hypothesis.after = hypothesis.before;
    }
    collect_evidence(hypotheses_, parts_, positions(old_, input_), config_.hypotheses);
    const auto apart = [&](int a, int b) {
      if (is_old(a) && is_old(b)) return old_place(a) != old_place(b);  // the map has decided on these
      return named_apart(parts_[at(a)].prototype, parts_[at(b)].prototype);
    };
    group_of_part_ = merge_accepted(static_cast<int>(parts_.size()), hypotheses_, apart);
  }

  void add_places(GrownMap& grown) {
    map::TopologicalMap& map = grown.map;
    map.images.insert(map.images.end(), fresh_.images.begin(), fresh_.images.end());
    grown.added.images = input_.new_images;
    const int groups = group_of_part_.empty() ? 0 : *std::ranges::max_element(group_of_part_) + 1;
    std::vector<std::vector<int>> images(at(groups));  // new ones of each group
    std::vector<int> place_of_group(at(groups), -1);
    for (std::size_t part = 0; part < parts_.size(); ++part) {
      const auto group = at(group_of_part_[part]);
      if (is_old(static_cast<int>(part))) {
        place_of_group[group] = old_place(static_cast<int>(part));
      } else {
        images[group].insert(images[group].end(), parts_[part].images.begin(), parts_[part].images.end());
      }
    }
    place_of_image_.assign(input_.images.size(), -1);
    std::set<int> joined;
    for (std::size_t group = 0; group < images.size(); ++group) {
      if (images[group].empty()) continue;
      std::ranges::sort(images[group]);
      int& place = place_of_group[group];
      if (place < 0) {
        place = static_cast<int>(map.places.size());
        map.places.push_back(new_place(images[group], map.next_place_number++));
        ++grown.added.places;
        ++grown.added.appearances;
      } else {
        join(map.places[at(place)], images[group]);
        joined.insert(place);
        grown.added.joined_images += static_cast<int>(images[group].size());
      }
      for (const int image : images[group]) place_of_image_[at(image)] = place;
    }
    for (int i = input_.new_images; i < static_cast<int>(input_.images.size()); ++i) {
      place_of_image_[at(i)] = input_.anchored(i);
    }
    grown.added.joined_places = static_cast<int>(joined.size());
  }

  [[nodiscard]] int marked_image(const std::vector<int>& images) const {
    const auto found = std::ranges::find_if(images, [&](int image) { return labels_[at(image)] != nullptr; });
    return found == images.end() ? -1 : *found;
  }

  [[nodiscard]] map::Place new_place(const std::vector<int>& images, std::int64_t number) const {
    const int marked = marked_image(images);
    const int prototype = marked >= 0 ? marked : medoid(images, [this](int a, int b) { return pairs_.distance(a, b); });
    map::Place place;
    place.id = PlaceId("p" + std::to_string(number));
    if (marked >= 0) place.label = *labels_[at(marked)];
    place.prototype = input_.images[at(prototype)].id;
    for (const int image : images) place.members.push_back(input_.images[at(image)].id);
    place.appearances.push_back(input_.appearances[at(prototype)]);
    return place;
  }

  void join(map::Place& place, const std::vector<int>& images) const {
    for (const int image : images) place.members.push_back(input_.images[at(image)].id);
    const int marked = marked_image(images);
    if (place.label.empty() && marked >= 0) place.label = *labels_[at(marked)];
  }

  void add_edges(GrownMap& grown) const {
    map::TopologicalMap& map = grown.map;
    std::set<std::pair<PlaceId, PlaceId>> settled;  // there already, or taken away by a person
    for (const map::Edge& edge : map.edges) settled.emplace(edge.from, edge.to);
    for (const map::Edit& edit : map.edits) {
      if (edit.kind != map::EditKind::kRemoveEdge || edit.undone) continue;
      const map::Place* a = map::find_place_of(map, edit.image_a);
      const map::Place* b = map::find_place_of(map, edit.image_b);
      if (a == nullptr || b == nullptr) continue;
      settled.emplace(a->id, b->id);
      settled.emplace(b->id, a->id);
    }
    Sights sights(all_);
    for (map::Edge& edge : form_edges(all_, path_, track_, config_, map.places, place_of_image_, sights)) {
      if (settled.contains({edge.from, edge.to})) continue;
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
    for (const LoopHypothesis& hypothesis : hypotheses_) {
      // The older image first.
      const int first = is_old(hypothesis.b) ? hypothesis.b : hypothesis.a;
      const int second = is_old(hypothesis.b) ? hypothesis.a : hypothesis.b;
      map::Hypothesis kept;
      kept.prototype_a = input_.images[at(parts_[at(first)].prototype)].id;
      kept.prototype_b = input_.images[at(parts_[at(second)].prototype)].id;
      kept.similarity = hypothesis.similarity;
      kept.masses_before = hypothesis.before;
      kept.masses_after = hypothesis.after;
      kept.support = support(hypothesis.after);
      kept.plausibility = plausibility(hypothesis.after);
      kept.decision = hypothesis.decision;
      kept.by = hypothesis.by;
      grown.map.hypotheses.push_back(std::move(kept));
    }
    grown.added.hypotheses = static_cast<int>(hypotheses_.size());
  }

  const map::TopologicalMap& old_;
  const GrowthInput& input_;
  const PairTable& pairs_;
  const MappingConfig& config_;
  MappingInput all_;    // new images and anchors
  MappingInput fresh_;  // new images alone
  TourPath path_;
  TourTrack track_;
  std::vector<const std::string*> labels_;  // of each image; null: none
  std::vector<Subcluster> parts_;
  std::vector<LoopHypothesis> hypotheses_;
  std::vector<int> group_of_part_;
  std::vector<int> place_of_image_;
};

}  // namespace

GrownMap grow_map(const map::TopologicalMap& old, const GrowthInput& input, const PairTable& pairs,
                  const MappingConfig& config) {
  return Growth(old, input, pairs, config).run();
}

}  // namespace homeward::mapping
