// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "support/lens_room.hpp"
#include "tracking/image_pyramid.hpp"

namespace homeward::testing {

/// Poses along a gentle bend, `step_m` apart.
inline std::vector<Pose2> bend(int count, double step_m = 0.08, double turn_rad = 0.01) {
  std::vector<Pose2> poses;
  Pose2 pose{-2.5, -0.6, 0.0};
  for (int i = 0; i < count; ++i) {
    poses.push_back(pose);
    pose.theta_rad += turn_rad;
    pose.x_m += step_m * std::cos(pose.theta_rad);
    pose.y_m += step_m * std::sin(pose.theta_rad);
  }
  return poses;
}

inline tracking::ImagePyramid pyramid_at(const PaintedRoom& room, const Pose2& pose, const camera::Camera& camera) {
  return tracking::ImagePyramid::build(lens_picture(room, pose, camera)).value();
}

}  // namespace homeward::testing
