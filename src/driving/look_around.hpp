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

/// How a robot looks around.
struct LookAroundConfig {
  double most_m = 12.0;      // so far it goes, and then gives up
  double step_m = 1.5;       // to the next spot that it looks from, at most,
  double least_way_m = 0.4;  // and at least
  double reached_m = 0.3;    // of that spot it is there
  double trail_m = 0.5;      // between two spots of where it was
  double keeps_off_m = 0.7;  // of what lies ahead
  double room_m = 0.1;       // beside the body
  double farthest_m = 4.0;   // how far room is looked for
  double turn_cost_m = 0.2;  // what turning half round is worth in room that is new
  int directions = 24;       // that it chooses from
};

/// Where to drive next, robot frame; nothing where there is no room, or it has driven far enough. `points_m`: what the
/// sweep hit, robot frame.
std::optional<Eigen::Vector2d> look_around(LookAround& state, const Body& body,
                                           std::span<const Eigen::Vector2d> points_m, const Pose2& odometry,
                                           const LookAroundConfig& config = {});

}  // namespace homeward::driving
