// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/result.hpp"
#include "planning/route.hpp"

namespace homeward::planning {

/// How far a second look leads away that is the mission's `look`th (from 0): each twice as far as the one before, which
/// has met nothing that tells where the robot is.
double second_look_m(int look);

/// The way from `request.from` to the nearest place that is `away_m` off by edges, or to the farthest where none is, 2
/// m at least, and back to where it began: a robot that is not sure of where it stands finds out by what it passes
/// (ours). Places come twice. What the request closes and avoids is not driven; its `to` does not count. Errors:
/// kUnknownPlace; kNoRoute where no way leads so far and back.
Result<Route> plan_second_look(const map::TopologicalMap& map, const RouteRequest& request, double away_m);

}  // namespace homeward::planning
