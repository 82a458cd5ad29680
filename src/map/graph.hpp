// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "map/topological_map.hpp"

namespace homeward::map {

/// A directed connection in a PlaceGraph.
struct Arc {
  int to = 0;    // index into map.places
  int edge = 0;  // index into map.edges
};

/// Neighbours of each place, by index into map.places. Edges whose ends do not exist are left out.
class PlaceGraph {
 public:
  explicit PlaceGraph(const TopologicalMap& map);
  [[nodiscard]] int size() const { return static_cast<int>(outgoing_.size()); }
  [[nodiscard]] std::span<const Arc> arcs_from(int place) const { return outgoing_[static_cast<std::size_t>(place)]; }

 private:
  std::vector<std::vector<Arc>> outgoing_;
};

/// The number of its connected component for each place, edges taken in both directions, blocked ones too.
/// Components are numbered by their first place.
std::vector<int> components(const PlaceGraph& graph);

/// A place that can be reached, and how many edges lead there.
struct Reached {
  int place = 0;
  int hops = 0;
};

/// All places at most `max_hops` edges from `from`, nearest first, `from` itself among them. Edges are driven forwards;
/// equally near places come in the order of their index.
/// Breadth first: the number of place transitions of Goedemé 2007 §5.2.
std::vector<Reached> reach(const PlaceGraph& graph, int from, int max_hops);

}  // namespace homeward::map
