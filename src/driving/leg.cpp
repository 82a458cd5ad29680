// SPDX-License-Identifier: Apache-2.0
#include "driving/leg.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>

#include "driving/asking.hpp"
#include "driving/give_way.hpp"
#include "driving/rider.hpp"
#include "driving/sense.hpp"

namespace homeward::driving {
namespace {

constexpr double kBrakes_per_s = 1.5;  // speed for each metre that is left, so that it comes to rest at the goal
constexpr double kLeast_mps = 0.1;

/// Where the goal lies, robot frame.
Eigen::Vector2d seen_from(const Pose2& odometry, const Eigen::Vector2d& goal_m) {
  return position_m(inverse(odometry) * Pose2{goal_m.x(), goal_m.y(), 0.0});
}

}  // namespace

bool begin_exploration(DrivingState& state, const Exploration& exploration, const Inputs& inputs,
                       const DrivingConfig& config, Milliseconds now_ms, Milliseconds sensors_ms) {
  if (exploration.order <= state.newest || exploration.order.epoch < state.least_epoch) return false;
  state.newest = exploration.order;
  if (rider_steers(inputs, config, sensors_ms) || now_ms < state.refuses_until_ms) return false;
  Mission mission;
  mission.id = exploration.id;
  mission.speed_limit_mps = exploration.speed_limit_mps;
  mission.explores = true;
  state.mission = std::make_shared<const Mission>(std::move(mission));
  state.permit_ends_ms = now_ms + exploration.valid_for_ms;
  state.drive = wire::DriveState::kDriving;
  state.reason.reset();
  state.follow = {};
  state.kept.reset();
  state.seen = {};
  state.leg = {};
  state.astray = state.at_odds = state.docking = state.covered = state.pictured = false;
  state.near_since_ms.reset();
  state.stays_since_ms.reset();
  state.last_message_ms = now_ms;
  state.last_gain_ms = state.last_picture_ms = state.picture_came_ms = sensors_ms;
  state.gain_from = inputs.odometry;
  state.plan = {};
  begin_sensing(state, inputs, config);
  begin_way(state.give_way, config.give_way);
  withdraw(state.asking);
  return true;
}

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
