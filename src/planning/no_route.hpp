// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "map/topological_map.hpp"
#include "planning/route_request.hpp"

namespace homeward::planning {

/// What keeps a robot from a way.
enum class ObstacleKind {
  kBlocked,  // an edge blocked in this direction (blocked both ways, or one-way by hand)
  kOneWay,   // an edge that the map has in the other direction alone
  kClosed,   // an edge that the request closes
  kAvoided,  // a place that the request avoids
};
struct Obstacle {
  ObstacleKind kind = ObstacleKind::kBlocked;
  Way way;  // of kAvoided: `to` is the place, `from` empty
};

/// Why there is no route.
struct NoRoute {
  bool connected = false;            // false: no tour joins the two, in no direction
  std::size_t places_near_from = 0;  // of the part of the map that `from` lies in; `to` lies in another
  std::vector<Obstacle> obstacles;   // connected: on the way with the fewest of them, in its order
};

/// Precondition: both places exist and plan_route found none.
NoRoute explain_no_route(const map::TopologicalMap& map, const RouteRequest& request);

/// "p3 (kitchen)", or "p3" where it has no name.
std::string named(const map::Place& place);

/// What explain_no_route finds, in sentences for people.
std::string no_route_text(const map::TopologicalMap& map, const RouteRequest& request);

}  // namespace homeward::planning
