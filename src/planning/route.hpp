// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/ids.hpp"
#include "core/result.hpp"
#include "map/topological_map.hpp"
#include "planning/route_request.hpp"

namespace homeward::planning {

struct Route {
  std::vector<PlaceId> places;  // from first to last, both included
  double cost_m = 0.0;          // length with the factor of weak edges applied
  double length_m = 0.0;
  double time_s = 0.0;
  std::vector<Way> weak;                                         // edges of it where homing is likely to fail
  std::vector<Way> shortcuts = {};                               // edges of it that no tour drove
  map::LengthSource length_from = map::LengthSource::kOdometry;  // the roughest source of a length in it
};

/// The cheapest drivable way (Dijkstra, Goedemé 2007 §6); blocked edges are not driven, and edges in their direction
/// alone. No place comes twice.
/// Errors: kUnknownPlace (which), kNoRoute (why: see explain_no_route).
Result<Route> plan_route(const map::TopologicalMap& map, const RouteRequest& request);

/// The `count` cheapest ways that pass no place twice, cheapest first, fewer where there are no more (Yen, "Finding the
/// k shortest loopless paths in a network", Management Science 17, 1971). The second is the next best way as a whole;
/// to get round one edge, close it instead. Errors: those of plan_route.
Result<std::vector<Route>> plan_routes(const map::TopologicalMap& map, const RouteRequest& request, int count);

}  // namespace homeward::planning
