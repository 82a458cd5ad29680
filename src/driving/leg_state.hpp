// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

namespace homeward::driving {

/// How a robot gets on with the leg that it drives.
struct LegState {
  std::optional<Eigen::Vector2d> goal_m;  // of the leg; odometry's frame
  double nearest_m = 0.0;                 // that it has come to it,
  std::int64_t nearer_ms = 0;             // and when, by the sensors' clock
  bool blocked = false;                   // it does not get any nearer: another leg is wanted
};

}  // namespace homeward::driving
