// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

namespace homeward::agent {

/// One sweep of range sensors in the robot frame. Ray i points angle_min_rad + i * angle_step_rad counter-clockwise
/// from forward; a range that is not finite or beyond range_max_m saw nothing.
struct Scan {
  std::vector<float> ranges_m;
  double angle_min_rad = 0.0;
  double angle_step_rad = 0.0;
  double range_max_m = 12.0;
};

/// The points that a sweep hit, robot frame.
std::vector<Eigen::Vector2d> hit_points(const Scan& scan);

}  // namespace homeward::agent
