// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "core/pose2.hpp"
#include "driving/body.hpp"

namespace homeward::driving {

/// Driving on a little for a robot that does not know which of several places it is at: from one spot they may look
/// alike, from a few metres on they do not. It goes where most room is, each time another way than it came.
/// Ours: docs/experiments/telling_twins_apart.md.
struct LookAround {
  std::optional<Eigen::Vector2d> aim_m;  // frame of odometry; nothing before the next is chosen
  Pose2 odometry;                        // at the latest step
  double driven_m = 0.0;
  std::vector<Eigen::Vector2d> been_m;  // where it was, every half metre
};

inline constexpr double kLooksAround_m = 12.0;  // so far it goes, and then gives up

/// Where to drive next, robot frame; nothing where there is no room, or it has driven far enough. `points_m`: what the
/// sweep hit, robot frame.
std::optional<Eigen::Vector2d> look_around(LookAround& state, const Body& body,
                                           std::span<const Eigen::Vector2d> points_m, const Pose2& odometry);

}  // namespace homeward::driving
