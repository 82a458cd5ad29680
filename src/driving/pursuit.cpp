// SPDX-License-Identifier: Apache-2.0
#include "driving/pursuit.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "core/pose2.hpp"

namespace homeward::driving {
namespace {

constexpr double kAhead_rad = 0.6;    // a goal further aside is turned to first
constexpr double kLeastLook_m = 0.4;  // the arc's chord
constexpr double kMostLook_m = 1.0;
constexpr double kFarthest_m = 2.0;  // beyond that the way may change before the robot is there
constexpr double kRoom_m = 0.2;      // beside the body; with less the middle of the way is looked for
constexpr double kStep_m = 0.1;
constexpr double kComfortRadius_m = 0.8;  // sharper arcs are driven slower
constexpr double kSlowest = 0.3;          // share of the speed

bool has_room(const Body& body, std::span<const Eigen::Vector2d> points_m, const Pose2& pose) {
  const Pose2 back = inverse(pose);
  const double c = std::cos(back.theta_rad);
  const double s = std::sin(back.theta_rad);
  std::vector<Eigen::Vector2d> then;
  then.reserve(points_m.size());
  std::ranges::transform(points_m, std::back_inserter(then), [&](const Eigen::Vector2d& point) -> Eigen::Vector2d {
    return {back.x_m + c * point.x() - s * point.y(), back.y_m + s * point.x() + c * point.y()};
  });
  return clearance_m(body, then) >= kRoom_m;
}

Pose2 along_arc(double length_m, double curvature) {
  const double turned_rad = length_m * curvature;
  const double half_rad = 0.5 * turned_rad;
  const double chord_m = std::abs(half_rad) < 1e-9 ? length_m : length_m * std::sin(half_rad) / half_rad;
  return {chord_m * std::cos(half_rad), chord_m * std::sin(half_rad), turned_rad};
}

}  // namespace

std::optional<Motion> pursue(const Body& body, std::span<const Eigen::Vector2d> points_m, const Eigen::Vector2d& goal_m,
                             double speed_mps) {
  const double distance_m = goal_m.norm();
  const double ahead_rad = std::atan2(goal_m.y(), goal_m.x());
  if (std::abs(ahead_rad) > kAhead_rad) return std::nullopt;
  const double look_m = std::clamp(distance_m, kLeastLook_m, kMostLook_m);
  const double curvature = 2.0 * std::sin(ahead_rad) / look_m;
  std::vector<Eigen::Vector2d> near;
  std::ranges::copy_if(points_m, std::back_inserter(near),
                       [](const Eigen::Vector2d& point) { return point.norm() < kFarthest_m + 1.5; });
  const double driven_m = std::min(distance_m, kFarthest_m);
  const double arc_m = std::min(look_m, distance_m);
  for (double along_m = 0.0; along_m < arc_m; along_m += kStep_m) {
    if (!has_room(body, near, along_arc(along_m, curvature))) return std::nullopt;
  }
  const Eigen::Vector2d direction = goal_m / std::max(distance_m, 1e-9);
  for (double along_m = arc_m; along_m < driven_m + kStep_m; along_m += kStep_m) {
    const double reached_m = std::min(along_m, driven_m);
    if (!has_room(body, near, {reached_m * direction.x(), reached_m * direction.y(), ahead_rad})) return std::nullopt;
  }
  const double share = std::clamp(1.0 / (kComfortRadius_m * std::max(std::abs(curvature), 1e-9)), kSlowest, 1.0);
  Motion motion;
  motion.speed_mps = speed_mps * share;
  motion.turn_radps = std::clamp(motion.speed_mps * curvature, -body.max_turn_radps, body.max_turn_radps);
  return motion;
}

}  // namespace homeward::driving
