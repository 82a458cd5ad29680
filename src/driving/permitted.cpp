// SPDX-License-Identifier: Apache-2.0
#include "driving/permitted.hpp"

#include <algorithm>
#include <cmath>

#include "driving/scan.hpp"
#include "driving/speed_limit.hpp"

namespace homeward::driving {
namespace {

/// No faster than what still comes to rest in time should the silence that has begun go on.
Motion slowed_by_silence(const Motion& wanted, const DrivingState& state, const DrivingConfig& config,
                         Milliseconds now_ms, Milliseconds sensors_ms) {
  const Milliseconds silence_ms =
      std::max({now_ms - state.last_message_ms, sensors_ms - state.picture_came_ms, sensors_ms - state.scan->taken_ms});
  const Milliseconds braking_ms = config.stands_within_ms - config.reaction_ms - silence_ms;
  const double braking_s = 0.001 * static_cast<double>(std::max<Milliseconds>(0, braking_ms));
  const double speed_mps = config.body.deceleration_mps2 * braking_s;
  const double turn_radps = config.body.turn_deceleration_radps2 * braking_s;
  return {std::clamp(wanted.speed_mps, -speed_mps, speed_mps), std::clamp(wanted.turn_radps, -turn_radps, turn_radps)};
}

}  // namespace

std::optional<wire::ReasonCode> reason_to_stop(const DrivingState& state, const Inputs& inputs,
                                               const DrivingConfig& config, Milliseconds now_ms,
                                               Milliseconds sensors_ms) {
  if (!inputs.link_up) return wire::ReasonCode::kLinkLost;
  if (now_ms - state.last_message_ms > config.link_silence_ms) return wire::ReasonCode::kServerSilent;
  if (now_ms > state.permit_ends_ms) return wire::ReasonCode::kPermitOver;
  const Milliseconds patience_ms = state.pictured ? config.frame_silence_ms : config.first_frame_ms;
  const bool camera_silent = sensors_ms - state.last_picture_ms > patience_ms;
  const bool ranges_silent = !state.scan || sensors_ms - state.scan->taken_ms > config.scan_silence_ms;
  // No sensor can be blamed for what does not reach us.
  if ((camera_silent || ranges_silent) && !inputs.robot_link_up) return wire::ReasonCode::kRobotLinkLost;
  if (camera_silent) return wire::ReasonCode::kCameraSilent;
  if (ranges_silent) return wire::ReasonCode::kRangeSensorSilent;
  return std::nullopt;
}

Motion permitted_motion(Motion wanted, const DrivingState& state, const DrivingConfig& config,
                        const std::vector<Eigen::Vector2d>& points_m, Milliseconds now_ms, Milliseconds sensors_ms) {
  if (!std::isfinite(wanted.speed_mps) || !std::isfinite(wanted.turn_radps)) return {};
  // The last decimetres and backing off have speeds of their own, which the limit holds for as well.
  const double limit_mps = speed_limit_mps(state, config);
  wanted.speed_mps = std::clamp(wanted.speed_mps, -limit_mps, limit_mps);
  Motion slowed = slowed_by_silence(wanted, state, config, now_ms, sensors_ms);
  // What no sensor looks at may be anything.
  const bool forward_only = !looks_behind(state.scan->scan);
  if (forward_only) slowed.speed_mps = std::max(0.0, slowed.speed_mps);
  const Motion safe = made_safe(slowed, config.body, points_m, state.turning.radps(), config.safety);
  return forward_only && !(safe.speed_mps >= 0.0) ? Motion{} : safe;
}

}  // namespace homeward::driving
