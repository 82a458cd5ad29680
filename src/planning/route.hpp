// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/ids.hpp"
#include "core/result.hpp"
#include "map/topological_map.hpp"

namespace homeward::planning {

struct RouteRequest {
  PlaceId from;
  PlaceId to;
  std::vector<PlaceId> avoid;
  double weak_edge_factor = 3.0;  // a weak edge costs so many times its length
};

struct Route {
  std::vector<PlaceId> places;  // from first to last, both included
  double cost_m = 0.0;          // length with the factors applied
};

/// The cheapest drivable way (Dijkstra, Goedemé 2007 §6); blocked edges are not driven.
/// Errors: kUnknownPlace (which), kNoRoute (why: other component, or only blocked edges or avoided places lead there).
Result<Route> plan_route(const map::TopologicalMap& map, const RouteRequest& request);

}  // namespace homeward::planning
