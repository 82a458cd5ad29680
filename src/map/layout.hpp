// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "map/topological_map.hpp"

namespace homeward::map {

/// Where to draw each place, in the order of map.places: x to the right, y downwards, both in [0,1], proportions kept.
/// For people only: drawn from what edges say about direction, turn and length, and from odometry where the tour has
/// it, so that the graph looks like the building's floor plan up to a turn. Components stand side by side.
/// Same map, same drawing.
/// Gauss-Seidel sweeps over a linear pose graph, headings first and then positions, as by Lu & Milios (1997); keeping
/// drawn places apart is ours.
std::vector<Eigen::Vector2d> layout(const TopologicalMap& map);

/// Whether two revisions of a map are drawn alike: the same places, from the same images, and the same edges but for
/// what is blocked.
bool drawn_alike(const TopologicalMap& a, const TopologicalMap& b);

}  // namespace homeward::map
