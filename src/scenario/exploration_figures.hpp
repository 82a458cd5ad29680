// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <unordered_map>
#include <vector>

#include "core/ids.hpp"
#include "core/pose2.hpp"
#include "map/topological_map.hpp"
#include "sim/scene.hpp"

namespace homeward::scenario {

/// Whether nothing of the world stands between two spots, by its grid of the floor.
bool in_sight(const sim::World& world, const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m);

/// Whether a spot lies within 2 m and in sight of one of the views.
bool is_covered(const sim::World& world, const std::vector<Eigen::Vector2d>& views_m, const Eigen::Vector2d& at_m);

/// What only the world knows of the map of an exploration.
struct ExplorationFigures {
  double reachable_m2 = 0.0;  // floor that the robot's middle can get to from its start
  double covered = 0.0;       // share of it within 2 m and in sight of a place's prototype
  int wrong_edges = 0;        // whose prototypes are more than 6 m apart
  int mixed_places = 0;       // with pictures of two rooms, or more than 4 m apart
};

/// `taken`: where the map's pictures were truly taken.
ExplorationFigures exploration_figures(const sim::World& world, const map::TopologicalMap& map,
                                       const std::unordered_map<ImageId, Pose2>& taken);

}  // namespace homeward::scenario
