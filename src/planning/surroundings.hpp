// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "map/metric_layout.hpp"
#include "map/topological_map.hpp"

namespace homeward::planning {

struct SurroundingsConfig {
  double beside_m = 8.0;          // places so near to one of the route
  std::size_t most_beside = 120;  // nearest first
  int alike = 3;                  // places that look most like each of the route,
  int alike_at_end = 8;           // and like the last one, before all others
  std::size_t most_alike = 80;
};

/// The places that a robot is to know beside those of its route, so that it can tell when it is off it: those that lie
/// near to it by `layout` (map::metric_layout of this map), and those that look like a place of it, wherever they lie;
/// the same of the places that are `likely` to be where the robot begins when that is not sure.
/// None of the route's own. Same map and route, same places.
/// Ours: a path of views alone (Goedemé 2007 §7) does not tell a robot that it left it:
/// docs/experiments/one_estimate_while_driving.md.
std::vector<PlaceId> surroundings(const map::TopologicalMap& map, std::span<const PlaceId> route,
                                  std::span<const PlaceId> likely, const map::MetricLayout& layout,
                                  const SurroundingsConfig& config = {});

}  // namespace homeward::planning
