// SPDX-License-Identifier: Apache-2.0
#include "driving/choose.hpp"

#include <algorithm>
#include <cmath>

#include "core/angles.hpp"
#include "driving/approach.hpp"
#include "driving/drive_towards.hpp"
#include "driving/end_mission.hpp"
#include "driving/estimated_position.hpp"
#include "driving/follow.hpp"
#include "driving/speed_limit.hpp"
#include "driving/steering.hpp"

namespace homeward::driving {
namespace {

using wire::ReasonCode;

/// The robot has a reason to stand.
Motion stand(DrivingState& state) {
  forget_standing(state.give_way);
  return {};
}

/// Heading at the end, by the latest answer and the turn made since.
Motion take_heading(DrivingState& state, const Situation& now) {
  if (state.covered) return {};
  const double left_rad = wrap_angle(state.follow.view.heading_rad() - now.inputs.odometry.theta_rad);
  if (!(std::abs(left_rad) < now.config.dock_within_rad)) return turn_in_place(left_rad, now.config.approach);
  end_mission(state, wire::DriveState::kArrived, std::nullopt);
  return {};
}

/// Where the robot does not know where it is, it drives on a little and looks; but not before it has seen something.
Motion look(DrivingState& state, const Situation& now) {
  forget_standing(state.give_way);
  if (state.follow.hypotheses.empty()) return {};
  state.reason = wire::Reason{ReasonCode::kLooksAround};
  const auto aim_m =
      look_around(state.looking, now.config.body, now.points_m, now.inputs.odometry, now.config.look_around);
  return aim_m ? drive_towards(state, *aim_m, now.config.speed.unsure_mps, now) : Motion{};
}

/// It knows where it is, or goes on as if it did.
void stop_looking(DrivingState& state) {
  state.looking = {};
  if (says(state.reason, ReasonCode::kLooksAround) || says(state.reason, ReasonCode::kGoesOnUnsure))
    state.reason.reset();
  if (state.follow.looked_around) state.reason = wire::Reason{ReasonCode::kGoesOnUnsure};
}

/// Back, or a moment's wait, for somebody who cannot get past; nothing where the robot goes on.
std::optional<Motion> make_room(DrivingState& state, const Situation& now) {
  if (state.near_since_ms) {
    forget_standing(state.give_way);
    return std::nullopt;
  }
  const auto motion = give_way_motion(state, now);
  if (!motion) return std::nullopt;
  // Whoever it makes room for stands before what it would recognise, and back it goes where it came along.
  state.last_answer_ms = now.sensors_ms;
  state.follow.blind_m = 0.0;
  return motion;
}

/// Where to drive to the destination's own view. Right before it its bearing is known better than its distance, so that
/// is driven along until the view lies abeam.
Eigen::Vector2d destination_aim_m(const DrivingState& state, const Eigen::Vector2d& goal_m,
                                  const DrivingConfig& config) {
  const bool by_bearing = !state.follow.measured && state.seen.vector && goal_m.norm() < config.least_aim_m;
  if (!by_bearing) return goal_m;
  const double bearing_rad = state.seen.vector->bearing_rad;
  return config.least_aim_m * Eigen::Vector2d(std::cos(bearing_rad), std::sin(bearing_rad));
}

/// The destination is approached so slowly that one picture's way is a fraction of the tolerance.
double destination_speed_mps(const DrivingState& state, const Eigen::Vector2d& goal_m, const SpeedConfig& speed) {
  const bool alike = state.follow.alike > speed.alike_share;
  return std::max(alike ? speed.alike_mps : speed.destination_mps, speed.destination_gain_per_s * goal_m.norm());
}

/// The less is recognised, the slower.
double slowed_by_doubt_mps(double speed_mps, const DrivingState& state, const SpeedConfig& speed) {
  if (!state.seen.answered || state.follow.looked_around) speed_mps = std::min(speed_mps, speed.unsure_mps);
  const double doubt_m = state.follow.view.doubt_m();
  return speed_mps * std::clamp(speed.without_doubt - speed.less_per_m * doubt_m, speed.least_share, 1.0);
}

Motion drive_to_view(DrivingState& state, const Eigen::Vector2d& goal_m, const Situation& now) {
  const DrivingConfig& config = now.config;
  const bool last_view = state.follow.index + 1 == static_cast<int>(state.mission->path.views.size());
  if (last_view && state.follow.measured && goal_m.norm() < config.approach.within_m)
    return approach(goal_m, config.body, now.points_m, config.approach);
  double speed_mps = speed_limit_mps(state, config);
  Eigen::Vector2d aim_m = goal_m;
  if (last_view) {
    speed_mps = std::min(speed_mps, destination_speed_mps(state, goal_m, config.speed));
    aim_m = destination_aim_m(state, goal_m, config);
  }
  return drive_towards(state, aim_m, slowed_by_doubt_mps(speed_mps, state, config.speed), now);
}

}  // namespace

Motion choose_motion(DrivingState& state, const Inputs& inputs, const DrivingConfig& config,
                     const std::vector<Eigen::Vector2d>& points_m, Milliseconds sensors_ms) {
  const Situation now{inputs, config, points_m, sensors_ms};
  if (state.docking) return take_heading(state, now);
  if (state.asking.since_ms) return stand(state);
  const double probability = position_probability(state.follow, state.mission->path);
  if (probability < drives_above(state.follow, config.follow) && !state.covered) return look(state, now);
  stop_looking(state);
  const auto goal_m = goal(state.follow, inputs.odometry, config.follow);
  if (!goal_m || state.covered) return stand(state);
  if (const auto making_room = make_room(state, now)) return *making_room;
  return drive_to_view(state, *goal_m, now);
}

}  // namespace homeward::driving
