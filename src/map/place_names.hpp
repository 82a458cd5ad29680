// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "map/topological_map.hpp"

namespace homeward::map {

/// What people call each place, in the order of map.places; never empty and no two alike. A place with a label, or a
/// destination, is called by that. Another is counted from the nearest of those, along the ways, towards the next one
/// that is reached without passing it: "third from the hall towards the study"; where there is none, "third past the
/// hall". What would be called alike, and what no way joins to anything with a name, is told by its id. The same graph
/// and labels give the same names, whatever ids a rebuild gives. Ours.
std::vector<std::string> place_names(const TopologicalMap& map);

}  // namespace homeward::map
