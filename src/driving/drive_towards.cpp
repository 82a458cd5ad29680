// SPDX-License-Identifier: Apache-2.0
#include "driving/drive_towards.hpp"

#include "driving/give_way.hpp"
#include "driving/pursuit.hpp"
#include "driving/steering.hpp"

namespace homeward::driving {

Motion drive_towards(DrivingState& state, const Eigen::Vector2d& aim_m, double speed_mps, const Situation& now) {
  const DrivingConfig& config = now.config;
  if (const auto straight = pursue(config.body, now.points_m, aim_m, speed_mps, config.pursuit)) return *straight;
  return steer_round(state.plan, config.body, now.points_m, aim_m, now.inputs.odometry, speed_mps, config.turn_gain,
                     config.steering);
}

std::optional<Motion> give_way_motion(DrivingState& state, const Situation& now) {
  const DrivingConfig& config = now.config;
  const Milliseconds patience_ms =
      is_round(config.body.outline) ? config.give_way.patience_ms : config.give_way.long_patience_ms;
  const auto back_m = give_way(state.give_way, config.body, {now.points_m, state.moving_obstacle.seen_ms},
                               now.inputs.odometry, now.sensors_ms, patience_ms, config.give_way);
  if (!back_m) return std::nullopt;
  if (back_m->isZero()) return Motion{};
  return steer_round(state.plan, config.body, now.points_m, *back_m, now.inputs.odometry, config.give_way.backing_mps,
                     config.turn_gain, config.steering);
}

}  // namespace homeward::driving
