// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "core/pose2.hpp"
#include "driving/scan.hpp"

namespace homeward::driving {

/// Whether anything about the robot moves of itself, seen while the robot stands or turns on the spot: somebody does,
/// sooner or later, and a thing does not.
struct MovingObstacle {
  std::optional<Scan> before;
  Pose2 before_from;  // odometry then
  std::int64_t before_ms = 0;
  std::optional<std::int64_t> seen_ms;  // when anything last moved
};

/// One sweep more, taken at `odometry`. Something has moved when it stands where a second ago the sweep looked through.
/// Ours, because somebody is worth waiting for and a thing is not.
void watch(MovingObstacle& state, const Scan& scan, const Pose2& odometry, std::int64_t now_ms);

}  // namespace homeward::driving
