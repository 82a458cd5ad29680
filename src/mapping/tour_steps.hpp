// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>

#include "map/topological_map.hpp"

namespace homeward::mapping {

/// The places whose images a tour took right before or after one of this place: the ways from it that were driven.
std::set<PlaceId> driven_from(const map::TopologicalMap& map, const map::Place& place);

/// An edge each way between two places where there is none, as long as the tour took from one prototype to the other,
/// where one tour took both. It has not been seen: weak.
void join_both_ways(map::TopologicalMap& map, const PlaceId& a, const PlaceId& b, map::Decider by);

}  // namespace homeward::mapping
