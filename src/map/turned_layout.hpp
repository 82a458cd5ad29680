// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "map/topological_map.hpp"

namespace homeward::map {

/// A drawing of a map (map/layout.hpp) turned so that the places it has in common with another map lie as they do in
/// that one's drawing, for two drawings beside each other; in [0,1] again, proportions kept. With fewer than two such
/// places it stays. Precondition: each drawing is of its map. The turn is that of Umeyama, Least-squares estimation of
/// transformation parameters (1991), in the plane.
std::vector<Eigen::Vector2d> turned_layout(const TopologicalMap& map, std::vector<Eigen::Vector2d> drawing,
                                           const TopologicalMap& other, const std::vector<Eigen::Vector2d>& of_other);

}  // namespace homeward::map
