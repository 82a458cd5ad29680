// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "raycast/ray_scene.hpp"
#include "sim/box.hpp"
#include "sim/people.hpp"

namespace homeward::sim {

/// How far along a ray the nearest of the world, its people and its boxes is: at most `far_m`, infinite where the ray
/// meets nothing that near.
float nearest_m(const raycast::RayScene& rays, const std::vector<Person>& people, const std::vector<Box>& boxes,
                const Eigen::Vector3f& origin_m, const Eigen::Vector3f& direction, float far_m);

/// The same of a ray that goes through panes of windows: where the world's first surface is one, its people and boxes
/// alone are met. What stands behind a pane is not looked for: nothing does in generated worlds.
float nearest_through_panes_m(const raycast::RayScene& rays, const std::vector<Person>& people,
                              const std::vector<Box>& boxes, const Eigen::Vector3f& origin_m,
                              const Eigen::Vector3f& direction, float far_m);

}  // namespace homeward::sim
