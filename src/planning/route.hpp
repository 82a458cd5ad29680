// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/ids.hpp"
#include "core/result.hpp"
#include "map/topological_map.hpp"

namespace homeward::planning {

/// What a route should have little of.
enum class RouteCost { kLength, kTime };

/// How long driving takes: an edge its length over the speed, a weak one at a share of it, a shortcut no faster than
/// its own speed; where two edges meet, the turn from one direction of travel into the other. A turn between edges of
/// which one has no bearing counts as none.
struct TravelModel {
  double speed_mps = 0.4;
  double turn_radps = 0.6;
  double weak_speed_share = 1.0 / 3.0;
  double shortcut_mps = 0.25;  // as the robot drives it
};

/// The way from one place to a neighbour.
struct Way {
  PlaceId from;
  PlaceId to;
  friend bool operator==(const Way&, const Way&) = default;
};

struct RouteRequest {
  PlaceId from;
  PlaceId to;
  std::vector<PlaceId> avoid;
  std::vector<Way> closed = {};  // not to be driven now, such as a way that has just failed; one direction each
  RouteCost by = RouteCost::kLength;
  double weak_edge_factor = 3.0;  // a weak edge costs so many times its length
  TravelModel travel = {};
};

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

}  // namespace homeward::planning
