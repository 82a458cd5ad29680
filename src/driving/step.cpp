// SPDX-License-Identifier: Apache-2.0
#include "driving/step.hpp"

#include <cmath>
#include <utility>

#include "driving/choose.hpp"
#include "driving/end_mission.hpp"
#include "driving/estimate.hpp"
#include "driving/leg.hpp"
#include "driving/orders.hpp"
#include "driving/permitted.hpp"
#include "driving/progress.hpp"
#include "driving/repeat_path.hpp"
#include "driving/rider.hpp"
#include "driving/sense.hpp"

namespace homeward::driving {
namespace {

bool is_driving(const DrivingState& state) { return state.drive == wire::DriveState::kDriving; }

/// A loop that was held up stops, and what was ordered meanwhile is refused: who ordered it no longer expects it.
void notice_gap(DrivingState& state, const DrivingConfig& config, Milliseconds now_ms) {
  const Milliseconds gap_ms = now_ms - state.last_step_ms.value_or(now_ms);
  state.last_step_ms = now_ms;
  if (gap_ms > config.held_up_ms) state.refuses_until_ms = now_ms + config.held_up_ms;
  if (gap_ms > config.loop_silence_ms && is_driving(state)) {
    end_mission(state, wire::DriveState::kStopped, wire::Reason{wire::ReasonCode::kComputerHeldUp});
  }
}

/// Also where the server may be about to send it on after a drive that failed: a hand on the joystick ends that.
void yield_to_rider(DrivingState& state) {
  const bool may_go_on = is_driving(state) || state.drive == wire::DriveState::kFailed;
  if (may_go_on) end_mission(state, wire::DriveState::kStopped, wire::Reason{wire::ReasonCode::kRiderTookOver});
}

void forget_old_belief(DrivingState& state, const DrivingConfig& config, Milliseconds now_ms) {
  if (now_ms - state.belief_ms <= config.belief_silence_ms) return;
  state.follow.belief.reset();
  state.follow.belief_lost = false;
}

/// Between two missions a robot hardly moves: odometry that says otherwise has begun anew.
void forget_where_odometry_jumped(DrivingState& state, const Pose2& odometry, const DrivingConfig& config) {
  const Pose2 moved = inverse(state.follow.odometry) * odometry;
  if (state.follow.begun && std::hypot(moved.x_m, moved.y_m) > config.odometry_jump_m) state.follow = {};
}

void begin_mission(DrivingState& state, const Inputs& inputs, const DrivingConfig& config, Milliseconds sensors_ms) {
  state.last_answer_ms = state.last_sure_ms = state.last_gain_ms = state.last_picture_ms = sensors_ms;
  state.gain_from = inputs.odometry;
  if (!state.mission->homes()) state.picture_came_ms = sensors_ms;
  state.leg = {};
  begin_repeat(state.repeat, inputs.odometry, sensors_ms);
  state.stays_since_ms.reset();
  state.plan = {};
  begin_sensing(state, inputs, config);
  begin_way(state.give_way, config.give_way);
  forget_where_odometry_jumped(state, inputs.odometry, config);
}

/// What server and rider say. The rider comes first.
void take_orders(DrivingState& state, const Inputs& inputs, bool rider, const DrivingConfig& config,
                 Milliseconds now_ms, Milliseconds sensors_ms, Outputs& outputs) {
  const std::shared_ptr<const Mission> before = state.mission;
  notice_gap(state, config, now_ms);
  if (rider) yield_to_rider(state);
  obey(state, inputs, rider, config, now_ms, outputs);
  forget_old_belief(state, config, now_ms);
  if (state.mission != before) begin_mission(state, inputs, config, sensors_ms);
}

/// Ends a mission that may not or cannot go on. Precondition: it drives.
void judge(DrivingState& state, const Inputs& inputs, const DrivingConfig& config, Milliseconds now_ms,
           Milliseconds sensors_ms) {
  if (const auto why = reason_to_stop(state, inputs, config, now_ms, sensors_ms)) {
    end_mission(state, wire::DriveState::kStopped, wire::Reason{*why});
  } else if (state.mission->explores && inputs.exploration_over) {
    const bool failed = inputs.exploration_over->failed;
    end_mission(state, failed ? wire::DriveState::kFailed : wire::DriveState::kArrived,
                inputs.exploration_over->reason);
  } else if (state.mission->explores) {
    judge_leg(state, inputs, sensors_ms);
  } else if (state.mission->repeats) {
    judge_repeat(state, inputs, config, sensors_ms);
  } else {
    judge_progress(state, config, sensors_ms);
  }
}

Motion wanted_motion(DrivingState& state, const Situation& now) {
  if (state.mission->explores) return leg_motion(state, now);
  if (state.mission->repeats) return repeat_motion(state, now);
  return choose_motion(state, now.inputs, now.config, now.points_m, now.sensors_ms);
}

}  // namespace

Outputs step(DrivingState& state, const Inputs& inputs, const DrivingConfig& config, Milliseconds now_ms) {
  Outputs outputs;
  const Milliseconds sensors_ms = inputs.sensors_now_ms.value_or(now_ms);
  const bool rider = rider_steers(inputs, config, sensors_ms);
  take_orders(state, inputs, rider, config, now_ms, sensors_ms, outputs);
  const std::vector<Eigen::Vector2d> points_m = sense(state, inputs, config, sensors_ms);
  estimate(state, inputs, config, now_ms, sensors_ms);
  if (rider)
    outputs.motion = rider_motion(*inputs.rider, state.scan, points_m, state.turning.radps(), config, sensors_ms);
  if (is_driving(state)) judge(state, inputs, config, now_ms, sensors_ms);
  if (!is_driving(state)) return outputs;
  const Motion wanted = wanted_motion(state, {inputs, config, points_m, sensors_ms});
  // It has arrived where it took the destination's heading just now.
  if (is_driving(state)) outputs.motion = permitted_motion(wanted, state, config, points_m, now_ms, sensors_ms);
  return outputs;
}

}  // namespace homeward::driving
