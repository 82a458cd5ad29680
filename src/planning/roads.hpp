// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "map/topological_map.hpp"
#include "planning/route_request.hpp"

namespace homeward::planning {

/// The map's edges with what they cost, and the cheapest chains of them. Costs of turns belong to pairs of edges, so
/// the search goes from edge to edge.
/// Goedemé 2007 §6 (Dijkstra), over edges as nodes: Caldwell, On finding minimum routes in a network with turn
/// penalties (1961).
class Roads {
 public:
  /// Edges that are not blocked; `by` and the models of the request decide on costs.
  Roads(const map::TopologicalMap& map, const RouteRequest& request);

  /// The cheapest chain of edges (indices into map.edges) from the end of edge `arrived_by`, or from `from` where it is
  /// nothing, to place `to`; none of the edges in `closed`, through none of the places in `avoided` (both as flags).
  /// Nothing where there is none. Precondition: `from` is not `to`. No place comes twice, `from` included.
  [[nodiscard]] std::optional<std::vector<int>> cheapest(int from, std::optional<int> arrived_by, int to,
                                                         std::span<const char> closed,
                                                         std::span<const char> avoided) const;
  /// Of a chain of edges, turns included; `arrived_by`: the edge before it.
  [[nodiscard]] double cost(std::span<const int> edges) const;

  [[nodiscard]] int from(int edge) const { return ends_[static_cast<std::size_t>(edge)].from; }
  [[nodiscard]] int to(int edge) const { return ends_[static_cast<std::size_t>(edge)].to; }
  [[nodiscard]] double seconds(int edge) const;
  [[nodiscard]] double turn_seconds(int before, int after) const;
  [[nodiscard]] double weighted_m(int edge) const;

 private:
  struct Ends {
    int from = -1;  // -1: the edge cannot be driven
    int to = -1;
  };
  [[nodiscard]] double own_cost(int edge) const;
  [[nodiscard]] double turn_cost(int before, int after) const;

  const map::TopologicalMap& map_;
  RouteCost by_;
  double weak_edge_factor_;
  TravelModel travel_;
  std::vector<Ends> ends_;                 // of each edge of the map
  std::vector<std::vector<int>> leaving_;  // edges by the place that they leave
};

}  // namespace homeward::planning
