// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/pose2.hpp"
#include "driving/body.hpp"
#include "driving/lattice.hpp"

namespace homeward::driving {

/// The way that a long body has begun. It is kept while it is free and no other is clearly cheaper: several ways round
/// things are often about as good, and deciding anew between them each time would lead nowhere.
struct LongPlan {
  std::vector<WayPose> poses;  // odometry's frame; empty: none
  std::size_t done = 0;        // the pose of it that the robot is at
  int age = 0;                 // calls since it was last compared with another
  Pose2 still_since;           // where the robot was when it last got on,
  int still = 0;               // so many calls ago
};

/// The motion that leads on along the plan to a goal in the robot frame; the plan is made anew where it has to be.
/// Standing still, without a plan, where the goal cannot be got nearer to.
/// Pure pursuit of the plan (Coulter 1992); when it is kept is ours.
Motion steer_long(LongPlan& plan, const Body& body, std::span<const Eigen::Vector2d> points_m,
                  const Eigen::Vector2d& goal_m, const Pose2& odometry, double speed_mps, double turn_gain);

}  // namespace homeward::driving
