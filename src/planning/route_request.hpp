// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/ids.hpp"

namespace homeward::planning {

/// What a route should have little of.
enum class RouteCost { kLength, kTime };

/// How long driving takes: an edge its length over the speed, a weak one at a share of it, a shortcut, or a way that a
/// person drew, no faster than its own speed; where two edges meet, the turn from one direction of travel into the
/// other. A turn between edges of which one has no bearing counts as none.
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

}  // namespace homeward::planning
