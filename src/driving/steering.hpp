// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>

#include "core/pose2.hpp"
#include "driving/body.hpp"
#include "driving/long_plan.hpp"

namespace homeward::driving {

/// The motion that leads a round body round what the sweep saw to a goal in the robot frame, slower in turns; standing
/// still when the robot is walled in, or the way is much longer than straight and its ranges are not vague. Beside
/// things it heads where there is more room first. `heading_rad`: the robot's, in any frame that does not turn with it.
/// `turn_gain`: turn rate for each radian towards the next point of the way. It is no promise that the motion is safe:
/// `made_safe` has the last word.
/// A proportional law towards the next point of local_path.hpp: ours.
Motion steer_round(const Body& body, std::span<const Eigen::Vector2d> points_m, const Eigen::Vector2d& goal_m,
                   double heading_rad, double speed_mps, double turn_gain);

/// The same for any body; one that is not round also turns in place and reverses, along a plan that is kept from call
/// to call (`steer_long`).
Motion steer_round(LongPlan& plan, const Body& body, std::span<const Eigen::Vector2d> points_m,
                   const Eigen::Vector2d& goal_m, const Pose2& odometry, double speed_mps, double turn_gain);

}  // namespace homeward::driving
