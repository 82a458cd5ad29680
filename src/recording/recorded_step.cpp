// SPDX-License-Identifier: Apache-2.0
#include "recording/recorded_step.hpp"

#include "driving/stated.hpp"

namespace homeward::recording {

db::RecordedSweep to_recorded(const driving::SeenScan& scan) {
  return {scan.taken_ms,         scan.scan.angle_min_rad, scan.scan.angle_step_rad,
          scan.scan.range_max_m, scan.scan.ranges_m,      scan.scan.robot_from_scan};
}

driving::SeenScan from_recorded(const db::RecordedSweep& sweep) {
  return {sweep.taken_ms,
          {sweep.ranges_m, sweep.angle_min_rad, sweep.angle_step_rad, sweep.range_max_m, sweep.robot_from_scan}};
}

void put_outcome(db::RecordedStep& step, const driving::DrivingState& state, const driving::Outputs& outputs) {
  step.speed_mps = outputs.motion.speed_mps;
  step.turn_radps = outputs.motion.turn_radps;
  step.state = state.drive;
  step.reason = state.reason;
  step.path_index = driving::stated_index(state);
  step.answered = state.seen.answered;
  step.docking = state.docking;
  step.covered = state.covered;
  step.vector.reset();
  step.tracks.reset();
  if (const auto& vector = state.seen.vector) {
    step.vector =
        db::RecordedVector{vector->bearing_rad, vector->turn_rad, vector->confidence, vector->median_parallax_rad,
                           vector->nearness,    vector->matches,  vector->inliers};
    const homing::TrackCounts& tracks = state.seen.tracks;
    step.tracks = db::RecordedTracks{tracks.tracked, tracks.recovered, tracks.lost};
  }
  step.min_range_m = state.min_range_m;
  step.sent = outputs.messages;
}

db::RecordedStep to_recorded(std::int64_t seq, const driving::Inputs& inputs, const PictureBytes& bytes,
                             const driving::DrivingState& state, const driving::Outputs& outputs,
                             driving::Milliseconds now_ms) {
  db::RecordedStep step;
  step.seq = seq;
  step.now_ms = now_ms;
  step.sensors_ms = inputs.sensors_now_ms;
  step.odometry = inputs.odometry;
  step.link_up = inputs.link_up;
  step.robot_link_up = inputs.robot_link_up;
  step.received = inputs.messages;
  if (inputs.scan) step.sweep = to_recorded(*inputs.scan);
  if (inputs.picture)
    step.picture = db::RecordedPicture{inputs.picture->taken_ms, inputs.picture->odometry, bytes,
                                       inputs.picture->appearance != nullptr, bytes != nullptr};
  if (inputs.rider) {
    step.rider = db::RecordedRider{inputs.rider->said_ms, inputs.rider->deflected, inputs.rider->wanted.speed_mps,
                                   inputs.rider->wanted.turn_radps};
  }
  if (inputs.leg) step.leg = db::RecordedLeg{inputs.leg->goal_m.x(), inputs.leg->goal_m.y(), inputs.leg->within_m};
  step.exploration_over = inputs.exploration_over.has_value();
  if (const auto& sight = inputs.path_sight) {
    step.path_sight =
        db::RecordedPathSight{sight->taken_ms,   sight->odometry,     sight->lost, sight->arc,  sight->tracked,
                              sight->confidence, sight->steering_rad, sight->way,  sight->ends, sight->leads_elsewhere};
  }
  step.path_unusable = inputs.why_not_repeating.has_value();
  put_outcome(step, state, outputs);
  return step;
}

namespace {

/// Why an order to explore was refused in a step: it came from outside the step. Nothing: none was.
std::optional<wire::Reason> why_refused(const db::RecordedStep& step) {
  for (const wire::ServerMessage& received : step.received) {
    const auto* order = std::get_if<wire::ExploreOrder>(&received);
    if (order == nullptr) continue;
    for (const wire::AgentMessage& sent : step.sent) {
      const auto* refused = std::get_if<wire::MissionRefused>(&sent);
      if (refused != nullptr && refused->mission == order->mission) return refused->reason;
    }
  }
  return std::nullopt;
}

/// Why a path could not be followed: how the mission ended, or why it was refused. Nothing: none was.
std::optional<wire::Reason> why_not_repeating(const db::RecordedStep& step) {
  if (!step.path_unusable) return std::nullopt;
  if (says(step.reason, wire::ReasonCode::kPathUnusable)) {
    const auto because = step.reason->parameters.find("because");
    if (because != step.reason->parameters.end()) {
      const auto* reasons = std::get_if<std::vector<wire::Reason>>(&because->second);
      if (reasons != nullptr && !reasons->empty()) return reasons->front();
    }
  }
  for (const wire::AgentMessage& sent : step.sent) {
    const auto* refused = std::get_if<wire::MissionRefused>(&sent);
    if (refused != nullptr) return refused->reason;
  }
  // It changed nothing.
  return wire::Reason{wire::ReasonCode::kDoesNotRepeat};
}

}  // namespace

driving::Inputs inputs_of(const db::RecordedStep& step) {
  driving::Inputs inputs;
  inputs.sensors_now_ms = step.sensors_ms;
  inputs.odometry = step.odometry;
  inputs.link_up = step.link_up;
  inputs.robot_link_up = step.robot_link_up;
  inputs.messages = step.received;
  if (step.sweep) inputs.scan = from_recorded(*step.sweep);
  if (step.picture && !step.picture->looked_at)
    inputs.picture = driving::SeenPicture{step.picture->taken_ms, nullptr, {}, step.picture->odometry};
  if (step.rider) {
    inputs.rider = driving::JoystickReading{
        step.rider->said_ms, step.rider->deflected, {step.rider->speed_mps, step.rider->turn_radps}};
  }
  if (step.leg) inputs.leg = driving::Leg{{step.leg->goal_x_m, step.leg->goal_y_m}, step.leg->within_m};
  inputs.why_not_exploring = why_refused(step);
  if (const auto& sight = step.path_sight) {
    inputs.path_sight = driving::PathSight{sight->taken_ms,
                                           sight->odometry,
                                           sight->lost,
                                           static_cast<int>(sight->arc),
                                           static_cast<int>(sight->tracked),
                                           sight->confidence,
                                           sight->steering_rad,
                                           sight->way,
                                           sight->ends,
                                           sight->leads_elsewhere};
  }
  inputs.why_not_repeating = why_not_repeating(step);
  if (step.exploration_over)
    inputs.exploration_over = driving::ExplorationOver{step.state == wire::DriveState::kFailed, step.reason};
  return inputs;
}

}  // namespace homeward::recording
