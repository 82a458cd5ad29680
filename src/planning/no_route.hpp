// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "planning/route.hpp"

namespace homeward::planning {

/// "p3 (kitchen)", or "p3" where it has no name.
std::string named(const map::Place& place);

/// What explain_no_route finds, in sentences for people.
std::string no_route_text(const map::TopologicalMap& map, const RouteRequest& request);

}  // namespace homeward::planning
