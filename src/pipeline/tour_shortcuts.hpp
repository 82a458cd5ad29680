// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/tour.hpp"
#include "map/topological_map.hpp"

namespace homeward::pipeline {

/// Adds to a map what mapping::propose_shortcuts finds by the sweeps of these tours; nothing where they have none.
void add_shortcuts(map::TopologicalMap& map, const std::vector<const TourSource*>& tours);

}  // namespace homeward::pipeline
