// SPDX-License-Identifier: Apache-2.0
#include "driving/rider.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace homeward::driving {

bool rider_steers(const Inputs& inputs, const DrivingConfig& config, Milliseconds sensors_ms) {
  return inputs.rider && inputs.rider->deflected &&
         std::abs(sensors_ms - inputs.rider->said_ms) <= config.rider_silence_ms;
}

Motion rider_motion(const JoystickReading& hand, const std::optional<SeenScan>& scan,
                    const std::vector<Eigen::Vector2d>& points_m, double turning_radps, const DrivingConfig& config,
                    Milliseconds sensors_ms) {
  if (!std::isfinite(hand.wanted.speed_mps) || !std::isfinite(hand.wanted.turn_radps)) return {};
  if (scan && sensors_ms - scan->taken_ms <= config.scan_silence_ms) {
    return made_safe(hand.wanted, config.body, points_m, turning_radps, config.safety);
  }
  const Motion creeping{std::clamp(hand.wanted.speed_mps, -config.rider_creep_mps, config.rider_creep_mps),
                        std::clamp(hand.wanted.turn_radps, -config.rider_creep_radps, config.rider_creep_radps)};
  return made_safe(creeping, config.body, {}, 0.0, config.safety);
}

}  // namespace homeward::driving
