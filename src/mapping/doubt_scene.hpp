// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/pose2.hpp"
#include "map/doubt.hpp"
#include "map/graph.hpp"
#include "map/metric_layout.hpp"
#include "map/topological_map.hpp"

namespace homeward::mapping {

/// Places by index into map.places, the smaller first.
using PlaceIndices = std::pair<int, int>;

/// Pictures of a place that a tour took one after the other, by index into map.images.
struct PlaceVisit {
  int first = 0;
  int last = 0;
  int before = -1;  // the place that the tour came from; -1: it began here, or nobody knows
  int after = -1;
  [[nodiscard]] int middle() const { return first + (last - first) / 2; }
};

/// A way between two places, both directions as one.
struct WayFacts {
  std::vector<int> edges;   // indices into map.edges
  double length_m = 0.0;    // the shorter direction; pictures counted as usual steps
  double confidence = 0.0;  // the surer direction
  int inliers = 0;          // the richer direction
  bool driven = false;      // a tour took a picture at one end right after one at the other
};

/// What doubts look at in a map, gathered once. The map must outlive it.
class DoubtScene {
 public:
  explicit DoubtScene(const map::TopologicalMap& map);

  [[nodiscard]] const map::TopologicalMap& map() const { return map_; }
  [[nodiscard]] const map::Place& place(int index) const { return map_.places[static_cast<std::size_t>(index)]; }
  [[nodiscard]] const ImageId& image(int index) const { return map_.images[static_cast<std::size_t>(index)].id; }
  /// -1: no place holds it.
  [[nodiscard]] int place_of(const ImageId& image) const;
  /// Index into map.images; -1: the tours do not have it.
  [[nodiscard]] int number_of(const ImageId& image) const;
  [[nodiscard]] const std::vector<PlaceVisit>& visits(int place) const { return visits_[at(place)]; }
  [[nodiscard]] const std::map<PlaceIndices, WayFacts>& ways() const { return ways_; }
  /// Null where there is none.
  [[nodiscard]] const WayFacts* way(int a, int b) const;
  [[nodiscard]] const std::vector<int>& beside(int place) const { return beside_[at(place)]; }

  /// Hypotheses whose two pictures are in this place, by index into the map's.
  [[nodiscard]] const std::vector<std::size_t>& hypotheses_within(int place) const { return within_[at(place)]; }

  // What people said by edits that stand.
  [[nodiscard]] bool parted_by_a_person(int a, int b) const { return parted_.contains(std::minmax(a, b)); }
  /// Whether one of them joined pictures of these with others of their place.
  [[nodiscard]] bool joined_by_a_person(const std::vector<ImageId>& pictures) const;
  /// Whether one of them drew, closed or opened the way between two places.
  [[nodiscard]] bool way_said_by_a_person(int a, int b) const { return said_ways_.contains(std::minmax(a, b)); }

  /// Who said last not to be sure of such a doubt about two places, or one and the same; empty: nobody.
  [[nodiscard]] std::string set_aside_by(map::DoubtKind kind, int a, int b) const;

  /// Metres between two pictures by the layout of the map; nothing where odometry does not join them.
  [[nodiscard]] std::optional<double> apart_m(const ImageId& a, const ImageId& b) const;

  /// The shortest way from one of `from` to one of `to` that uses neither the place `without` nor the way between the
  /// two of `closed`; at most `most_m` (Dijkstra 1959).
  [[nodiscard]] double way_m(std::span<const int> from, std::span<const int> to, int without,
                             std::optional<PlaceIndices> closed, double most_m) const;

 private:
  static std::size_t at(int index) { return static_cast<std::size_t>(index); }
  void find_visits();
  void find_ways();
  void find_hypotheses();
  void read_edits();

  const map::TopologicalMap& map_;
  std::unordered_map<ImageId, int> number_;
  std::vector<int> place_of_;  // of each image
  std::vector<std::vector<PlaceVisit>> visits_;
  std::map<PlaceIndices, WayFacts> ways_;
  std::vector<std::vector<int>> beside_;
  std::vector<std::vector<std::size_t>> within_;
  std::set<PlaceIndices> parted_;
  std::vector<std::pair<ImageId, ImageId>> joined_;
  std::set<PlaceIndices> said_ways_;
  std::map<std::pair<map::DoubtKind, PlaceIndices>, std::string> set_aside_;
  map::MetricLayout layout_;
};

}  // namespace homeward::mapping
