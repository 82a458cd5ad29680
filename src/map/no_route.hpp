// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/ids.hpp"

namespace homeward::map {

/// What keeps a robot from a way.
enum class ObstacleKind {
  kBlocked,  // an edge blocked in this direction (blocked both ways, or one-way by hand)
  kOneWay,   // an edge that the map has in the other direction alone
  kClosed,   // an edge that the request closes
  kAvoided,  // a place that the request avoids
};

struct Obstacle {
  ObstacleKind kind = ObstacleKind::kBlocked;
  PlaceId from;  // empty of kAvoided
  PlaceId to;    // of kAvoided: the place
};

/// Why there is no route.
struct NoRoute {
  PlaceId from;
  PlaceId to;
  bool connected = false;            // false: no tour joins the two, in no direction
  std::size_t places_near_from = 0;  // of the part of the map that `from` lies in; `to` lies in another
  std::vector<Obstacle> obstacles;   // connected: on the way with the fewest of them, in its order
};

}  // namespace homeward::map
