// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>

#include "core/pose2.hpp"
#include "driving/body.hpp"
#include "driving/long_plan.hpp"

namespace homeward::driving {

/// How a body is led round what stands in its way: a round one, and one that is not (`long_plan`).
struct SteeringConfig {
  double close_m = 0.1;           // with less room the way out is looked for first
  double enough_m = 0.08;         // so much room it wants before it minds nothing but its way
  double outwards = 0.3;          // room gained for each metre, up to that
  double look_m = 0.16;           // so far ahead
  double heading_step_rad = 0.1;  // from one heading tried to the next
  double near_m = 1.5;            // things farther away do not matter for the next step
  double alike_m = 0.002;         // room that differs less is the same
  double look_s = 0.8;            // for so long room is asked for while it still turns,
  double step_s = 0.2;            // at steps of that
  double longest_share = 2.0;     // a way more times as long as straight,
  double longer_m = 1.5;          // and by more than that, leads behind walls mostly: it waits
  double turn_first_rad = 0.9;    // a way further aside is turned to in place
  double slowest_share = 0.15;    // of the speed, right before that
  LongPlanConfig long_plan;
};

/// The motion that leads a round body round what the sweep saw to a goal in the robot frame, slower in turns; standing
/// still when the robot is walled in, or the way is much longer than straight and its ranges are not vague. Beside
/// things it heads where there is more room first. `heading_rad`: the robot's, in any frame that does not turn with it.
/// `turn_gain`: turn rate for each radian towards the next point of the way. It is no promise that the motion is safe:
/// `made_safe` has the last word.
/// A proportional law towards the next point of local_path.hpp: ours.
Motion steer_round(const Body& body, std::span<const Eigen::Vector2d> points_m, const Eigen::Vector2d& goal_m,
                   double heading_rad, double speed_mps, double turn_gain, const SteeringConfig& config = {});

/// The same for any body; one that is not round also turns in place and reverses, along a plan that is kept from call
/// to call (`steer_long`).
Motion steer_round(LongPlan& plan, const Body& body, std::span<const Eigen::Vector2d> points_m,
                   const Eigen::Vector2d& goal_m, const Pose2& odometry, double speed_mps, double turn_gain,
                   const SteeringConfig& config = {});

}  // namespace homeward::driving
