// SPDX-License-Identifier: Apache-2.0
#include "driving/approach.hpp"

#include <algorithm>
#include <cmath>

#include "core/angles.hpp"

namespace homeward::driving {
namespace {

/// Whether a little more straight ahead, or back, leaves the body more room than it needs to pass a door: the last
/// centimetres to a destination are not worth going as near to things as that.
bool leaves_room(const Body& body, const std::vector<Eigen::Vector2d>& points_m, double speed_mps,
                 const ApproachConfig& config) {
  std::vector<Eigen::Vector2d> then_m = points_m;
  for (Eigen::Vector2d& point : then_m) point.x() -= std::copysign(config.room_ahead_m, speed_mps);
  const double room_m = clearance_m(body, then_m);
  return room_m >= config.room_m || room_m >= clearance_m(body, points_m);
}

}  // namespace

Motion approach(const Eigen::Vector2d& goal_m, const Body& body, const std::vector<Eigen::Vector2d>& points_m,
                const ApproachConfig& config) {
  const double ahead_rad = std::atan2(goal_m.y(), goal_m.x());
  const bool behind = std::abs(ahead_rad) > 0.5 * kPi;
  const double off_rad = behind ? wrap_angle(ahead_rad + kPi) : ahead_rad;
  Motion motion;
  motion.turn_radps = std::clamp(config.turn_gain_per_s * off_rad, -config.most_turn_radps, config.most_turn_radps);
  motion.turn_radps = std::clamp(motion.turn_radps, -body.max_turn_radps, body.max_turn_radps);
  if (std::abs(off_rad) < config.aligned_rad) {
    const double speed_mps = std::max(config.slowest_mps, config.speed_gain_per_s * goal_m.norm());
    motion.speed_mps = behind ? -std::min(speed_mps, config.backward_mps) : std::min(speed_mps, config.forward_mps);
  }
  if (!leaves_room(body, points_m, motion.speed_mps, config)) motion.speed_mps = 0.0;
  return motion;
}

Motion turn_in_place(double left_rad, const ApproachConfig& config) {
  const double turn_radps =
      std::clamp(config.turn_gain_per_s * left_rad, -config.most_turn_radps, config.most_turn_radps);
  return {0.0, std::copysign(std::max(config.least_turn_radps, std::abs(turn_radps)), left_rad)};
}

}  // namespace homeward::driving
