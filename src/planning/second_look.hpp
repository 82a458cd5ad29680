// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/result.hpp"
#include "planning/route.hpp"

namespace homeward::planning {

/// The way from `request.from` to the nearest place that is `away_m` off by edges, or to the farthest where none is,
/// and back to where it began: a robot that is not sure of where it stands finds out by what it passes (ours). Places
/// come twice. What the request closes and avoids is not driven; its `to` does not count. Errors: kUnknownPlace;
/// kNoRoute where no way leads anywhere and back.
Result<Route> plan_second_look(const map::TopologicalMap& map, const RouteRequest& request, double away_m = 5.0);

}  // namespace homeward::planning
