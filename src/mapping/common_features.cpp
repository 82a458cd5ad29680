// SPDX-License-Identifier: Apache-2.0
#include "mapping/common_features.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <queue>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>

#include "core/index.hpp"
#include "features/aggregate.hpp"
#include "map/lookup.hpp"
#include "mapping/edit_log.hpp"
#include "mapping/parallel.hpp"
#include "matching/distinctiveness.hpp"
#include "matching/retrieval_index.hpp"

namespace homeward::mapping {
namespace {

/// Places with their neighbours either way.
class Ways {
 public:
  Ways(const map::TopologicalMap& map, const map::PlaceGraph& graph) : beside_(map.places.size()) {
    metric_ = std::ranges::all_of(
        map.edges, [](const map::Edge& edge) { return edge.length_from != map::LengthSource::kTourImages; });
    for (int from = 0; from < graph.size(); ++from) {
      for (const map::Arc& arc : graph.arcs_from(from)) {
        const double cost = metric_ ? map.edges[at(arc.edge)].length_m : 1.0;
        beside_[at(from)].emplace_back(arc.to, cost);
        beside_[at(arc.to)].emplace_back(from, cost);
      }
    }
  }

  [[nodiscard]] bool metric() const { return metric_; }

  /// Which places are less than `far` away (Dijkstra 1959, no further than that).
  [[nodiscard]] std::vector<char> nearer_than(double far, int place) const {
    std::vector<double> away(beside_.size(), std::numeric_limits<double>::infinity());
    std::vector<char> near(beside_.size(), 0);
    using Reached = std::pair<double, int>;
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
    away[at(place)] = 0.0;
    open.emplace(0.0, place);
    while (!open.empty()) {
      const auto [length, here] = open.top();
      open.pop();
      if (length > away[at(here)]) continue;
      near[at(here)] = 1;
      for (const auto& [next, cost] : beside_[at(here)]) {
        if (length + cost >= far || length + cost >= away[at(next)]) continue;
        away[at(next)] = length + cost;
        open.emplace(away[at(next)], next);
      }
    }
    return near;
  }

 private:
  bool metric_ = true;
  std::vector<std::vector<std::pair<int, double>>> beside_;
};

/// Pairs of places that may be one.
std::set<std::pair<int, int>> undecided_pairs(const map::TopologicalMap& map) {
  std::unordered_map<ImageId, int> place_of;
  for (std::size_t p = 0; p < map.places.size(); ++p) {
    for (const ImageId& image : map.places[p].members) place_of.emplace(image, static_cast<int>(p));
  }
  std::set<std::pair<int, int>> pairs;
  for (const map::Hypothesis& hypothesis : map.hypotheses) {
    const auto a = place_of.find(hypothesis.prototype_a);
    const auto b = place_of.find(hypothesis.prototype_b);
    if (hypothesis.decision != map::Decision::kUndecided || a == place_of.end() || b == place_of.end()) continue;
    pairs.insert(std::minmax(a->second, b->second));
  }
  return pairs;
}

matching::SeenPlace seen_at(const map::Place& place) {
  matching::SeenPlace seen;
  for (const features::Appearance& appearance : place.appearances) seen.push_back(&appearance.sift);
  return seen;
}

/// Chooses, of many far places, those that look most like a place.
class LookAlikes {
 public:
  LookAlikes(const map::TopologicalMap& map, int most) : map_(map), most_(at(std::max(0, most))) {
    if (map.places.size() <= most_) return;
    constexpr std::uint64_t kSeed = 1;
    std::vector<const features::FeatureSet*> sets;
    for (const map::Place& place : map.places) {
      if (!place.appearances.empty()) sets.push_back(&place.appearances.front().sift);
    }
    auto words = features::train_vocabulary(sets, matching::kRetrievalWords, kSeed);
    if (!words) return;
    auto index = matching::RetrievalIndex::create(std::move(*words));
    if (!index) return;
    for (std::size_t p = 0; p < map.places.size(); ++p) {
      if (map.places[p].appearances.empty()) continue;
      // Leading zeros: equals go by number. One without features is like none.
      const std::string number = std::to_string(p);
      static_cast<void>(index->add(std::string(10 - std::min<std::size_t>(10, number.size()), '0') + number,
                                   map.places[p].appearances.front().sift));
    }
    index_.emplace(std::move(*index));
  }

  /// Of `far`, ascending: all where they are few.
  [[nodiscard]] std::vector<matching::SeenPlace> of(const features::FeatureSet& set,
                                                    const std::vector<int>& far) const {
    std::vector<int> chosen;
    if (far.size() > most_ && index_) {
      for (const matching::Candidate& candidate : index_->query(set, map_.places.size())) {
        const int place = std::stoi(candidate.id);
        if (chosen.size() < most_ && std::ranges::binary_search(far, place)) chosen.push_back(place);
      }
    } else {
      chosen.assign(far.begin(), far.begin() + static_cast<std::ptrdiff_t>(std::min(far.size(), most_)));
    }
    std::vector<matching::SeenPlace> seen;
    seen.reserve(chosen.size());
    for (const int place : chosen) seen.push_back(seen_at(map_.places[at(place)]));
    return seen;
  }

 private:
  const map::TopologicalMap& map_;
  std::size_t most_;
  std::optional<matching::RetrievalIndex> index_;
};

}  // namespace

std::vector<std::vector<int>> far_places(const map::TopologicalMap& map, const CommonFeaturesConfig& config) {
  const map::PlaceGraph graph(map);
  const Ways ways(map, graph);
  const std::vector<int> component = map::components(graph);
  const auto undecided = undecided_pairs(map);
  const double far = ways.metric() ? config.far_m : static_cast<double>(config.far_hops);
  std::vector<std::vector<int>> far_of(map.places.size());
  for (int place = 0; place < graph.size(); ++place) {
    const std::vector<char> near = ways.nearer_than(far, place);
    for (int other = 0; other < graph.size(); ++other) {
      if (near[at(other)] != 0 || component[at(other)] != component[at(place)]) continue;
      if (!undecided.contains(std::minmax(place, other))) far_of[at(place)].push_back(other);
    }
  }
  return far_of;
}

struct CommonFeatures::Parts {
  std::vector<std::vector<int>> far;
  LookAlikes look_alikes;
};

CommonFeatures::CommonFeatures(const map::TopologicalMap& map, const CommonFeaturesConfig& config)
    : parts_(std::make_unique<const Parts>(Parts{far_places(map, config), LookAlikes(map, config.most_places)})) {}
CommonFeatures::~CommonFeatures() = default;

std::vector<std::uint8_t> CommonFeatures::frequency(const features::FeatureSet& set, int place) const {
  const std::vector<int>& far = parts_->far[at(place)];
  if (far.empty()) return {};
  return matching::document_frequency(set, parts_->look_alikes.of(set, far));
}

bool count_common_features(map::TopologicalMap& map, const CommonFeaturesConfig& config, int threads,
                           const std::stop_token& stop) {
  const map::TopologicalMap before = map;
  const CommonFeatures common(before, config);
  const auto places = map.places.size();
  std::vector<std::vector<std::vector<std::uint8_t>>> of_places(places);
  std::vector<std::vector<std::uint8_t>> of_destinations(map.destinations.size());
  const auto count = [&](std::size_t i) {
    if (i < places) {
      for (const features::Appearance& appearance : map.places[i].appearances) {
        of_places[i].push_back(common.frequency(appearance.sift, static_cast<int>(i)));
      }
      return;
    }
    const map::Destination& destination = map.destinations[i - places];
    const map::Place* place = map::find_place(map, destination.place);
    if (place == nullptr) return;
    of_destinations[i - places] =
        common.frequency(destination.appearance.sift, static_cast<int>(place - map.places.data()));
  };
  if (!parallel_for(places + map.destinations.size(), threads, count, {}, stop)) return false;
  for (std::size_t p = 0; p < places; ++p) {
    for (std::size_t i = 0; i < of_places[p].size(); ++i) {
      features::Appearance counted = map.places[p].appearances[i];
      counted.sift.document_frequency = std::move(of_places[p][i]);
      map.places[p].appearances.replace(i, std::move(counted), map.places[p].appearances.entries()[i].image);
    }
  }
  for (std::size_t d = 0; d < map.destinations.size(); ++d) {
    map.destinations[d].appearance.sift.document_frequency = std::move(of_destinations[d]);
  }
  carry_over(before, map);
  return true;
}

}  // namespace homeward::mapping
