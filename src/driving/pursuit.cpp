// SPDX-License-Identifier: Apache-2.0
#include "driving/pursuit.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "core/pose2.hpp"

namespace homeward::driving {
namespace {

Pose2 along_arc(double length_m, double curvature) {
  const double turned_rad = length_m * curvature;
  const double half_rad = 0.5 * turned_rad;
  const double chord_m = std::abs(half_rad) < 1e-9 ? length_m : length_m * std::sin(half_rad) / half_rad;
  return {chord_m * std::cos(half_rad), chord_m * std::sin(half_rad), turned_rad};
}

}  // namespace

std::optional<Motion> pursue(const Body& body, std::span<const Eigen::Vector2d> points_m, const Eigen::Vector2d& goal_m,
                             double speed_mps, const PursuitConfig& config) {
  const double distance_m = goal_m.norm();
  const double ahead_rad = std::atan2(goal_m.y(), goal_m.x());
  if (std::abs(ahead_rad) > config.ahead_rad) return std::nullopt;
  const double look_m = std::clamp(distance_m, config.least_look_m, config.most_look_m);
  const double curvature = 2.0 * std::sin(ahead_rad) / look_m;
  std::vector<Eigen::Vector2d> near;
  std::ranges::copy_if(points_m, std::back_inserter(near), [&](const Eigen::Vector2d& point) {
    return point.norm() < config.farthest_m + config.beyond_m;
  });
  const double driven_m = std::min(distance_m, config.farthest_m);
  const double arc_m = std::min(look_m, distance_m);
  for (double along_m = 0.0; along_m < arc_m; along_m += config.step_m) {
    if (clearance_at_m(body, near, along_arc(along_m, curvature)) < config.room_m) return std::nullopt;
  }
  const Eigen::Vector2d direction = goal_m / std::max(distance_m, 1e-9);
  for (double along_m = arc_m; along_m < driven_m + config.step_m; along_m += config.step_m) {
    const double reached_m = std::min(along_m, driven_m);
    const Pose2 there{reached_m * direction.x(), reached_m * direction.y(), ahead_rad};
    if (clearance_at_m(body, near, there) < config.room_m) return std::nullopt;
  }
  const double share =
      std::clamp(1.0 / (config.comfort_radius_m * std::max(std::abs(curvature), 1e-9)), config.slowest_share, 1.0);
  Motion motion;
  motion.speed_mps = speed_mps * share;
  motion.turn_radps = std::clamp(motion.speed_mps * curvature, -body.max_turn_radps, body.max_turn_radps);
  return motion;
}

}  // namespace homeward::driving
