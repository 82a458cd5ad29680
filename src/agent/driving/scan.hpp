// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/pose2.hpp"

namespace homeward::agent {

/// One sweep of range sensors. Ray i starts at the scanner and points angle_min_rad + i * angle_step_rad
/// counter-clockwise from its forward; a range that is not finite or beyond range_max_m saw nothing.
struct Scan {
  std::vector<float> ranges_m;
  double angle_min_rad = 0.0;
  double angle_step_rad = 0.0;
  double range_max_m = 12.0;
  Pose2 robot_from_scan;
};

/// The points that a sweep hit, robot frame.
std::vector<Eigen::Vector2d> hit_points(const Scan& scan);

/// Whether the sweep's rays cover everything within 60 degrees of straight back from the robot.
bool looks_behind(const Scan& scan);

}  // namespace homeward::agent
