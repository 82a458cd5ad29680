// SPDX-License-Identifier: Apache-2.0
#include "driving/leg.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "driving/give_way.hpp"

namespace homeward::driving {
namespace {

constexpr double kBrakes_per_s = 1.5;  // speed for each metre that is left, so that it comes to rest at the goal
constexpr double kLeast_mps = 0.1;

/// Where the goal lies, robot frame.
Eigen::Vector2d seen_from(const Pose2& odometry, const Eigen::Vector2d& goal_m) {
  return position_m(inverse(odometry) * Pose2{goal_m.x(), goal_m.y(), 0.0});
}

}  // namespace

void judge_leg(DrivingState& state, const Inputs& inputs, Milliseconds sensors_ms, const LegConfig& leg) {
  LegState& now = state.leg;
  const bool wanted = inputs.leg && seen_from(inputs.odometry, inputs.leg->goal_m).norm() > inputs.leg->within_m;
  const Pose2 moved = inverse(now.got_on_at) * inputs.odometry;
  const bool gets_on = position_m(moved).norm() > leg.gets_on_m || std::abs(moved.theta_rad) > leg.gets_on_rad;
  // Another one may be free: it begins anew.
  if (!wanted || !now.begun || now.blocked || gets_on) {
    now.got_on_at = inputs.odometry;
    now.got_on_ms = sensors_ms;
  }
  const bool elsewhere = position_m(inverse(now.spot) * inputs.odometry).norm() > leg.spot_m;
  if (!wanted || !now.begun || now.blocked || elsewhere) {
    now.spot = inputs.odometry;
    now.at_spot_since_ms = sensors_ms;
  }
  now.begun = true;
  const bool obstacle_moves =
      state.moving_obstacle.seen_ms && sensors_ms - *state.moving_obstacle.seen_ms < leg.blocked_ms;
  const Milliseconds patience_ms = obstacle_moves ? leg.patience_ms : leg.blocked_ms;
  now.blocked = sensors_ms - now.got_on_ms > patience_ms || sensors_ms - now.at_spot_since_ms > leg.at_spot_ms;
}

Motion leg_motion(DrivingState& state, const Situation& now) {
  const Eigen::Vector2d goal_m =
      now.inputs.leg ? seen_from(now.inputs.odometry, now.inputs.leg->goal_m) : Eigen::Vector2d::Zero();
  // It stands until the camera shows something, and where that is next to nothing.
  const bool blind = !state.pictured || state.covered;
  if (blind || !now.inputs.leg || goal_m.norm() <= now.inputs.leg->within_m) {
    forget_standing(state.give_way);
    return {};
  }
  if (const auto making_room = give_way_motion(state, now)) return *making_room;
  const double speed_mps =
      std::min(state.mission->speed_limit_mps, std::max(kLeast_mps, kBrakes_per_s * goal_m.norm()));
  return drive_towards(state, goal_m, speed_mps, now);
}

}  // namespace homeward::driving
