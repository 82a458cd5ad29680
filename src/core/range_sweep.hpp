// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/pose2.hpp"

namespace homeward {

/// One sweep of range sensors. Ray i starts at the scanner and points angle_min_rad + i * angle_step_rad
/// counter-clockwise from its forward; a range that is not finite or not below range_max_m saw nothing.
struct RangeSweep {
  std::vector<float> ranges_m;
  double angle_min_rad = 0.0;
  double angle_step_rad = 0.0;
  double range_max_m = 12.0;
  Pose2 robot_from_scan;
};

}  // namespace homeward
