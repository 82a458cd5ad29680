// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "map/no_route.hpp"
#include "map/topological_map.hpp"
#include "planning/route_request.hpp"

namespace homeward::planning {

/// Why there is no route. Precondition: both places exist and plan_route found none.
map::NoRoute explain_no_route(const map::TopologicalMap& map, const RouteRequest& request);

/// "p3 (kitchen)", or "p3" where it has no name.
std::string named(const map::Place& place);

/// What explain_no_route finds, in sentences for people.
std::string no_route_text(const map::TopologicalMap& map, const RouteRequest& request);

}  // namespace homeward::planning
