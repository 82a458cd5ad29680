// SPDX-License-Identifier: Apache-2.0
#include "driving/body.hpp"

#include <algorithm>
#include <cmath>

namespace homeward::driving {
namespace {

/// What one sweep shows about a body.
struct Around {
  std::span<const Eigen::Vector2d> points_m;
  double now_m = 0.0;          // room that there is
  double turning_radps = 0.0;  // of the body as it moves now
  const SafetyConfig& config;
};

/// Whether an arc of so many seconds leaves the body its margin.
bool keeps_clear(const Motion& motion, const Body& body, const Around& around, double horizon_s) {
  const SafetyConfig& config = around.config;
  for (double t_s = config.step_s; t_s < horizon_s + config.step_s; t_s += config.step_s) {
    const double then_m = clearance_m(body, seen_after(around.points_m, motion, std::min(t_s, horizon_s)));
    // Already too close: leaving is fine, coming nearer is not.
    if (then_m < config.margin_m && then_m < around.now_m - 1e-4) return false;
  }
  return true;
}

bool is_safe(const Motion& motion, const Body& body, const Around& around) {
  double braking_s = std::abs(motion.speed_mps) / body.deceleration_mps2;
  if (!is_round(body.outline)) {
    braking_s = std::max(braking_s, std::abs(motion.turn_radps) / body.turn_deceleration_radps2);
  }
  return keeps_clear(motion, body, around, around.config.reaction_s + braking_s);
}

/// Whether it is safe as well while the body still turns as it does now: a bend past a thing, wanted for one sweep, and
/// the opposite bend for the next lead straight into it, as wheels take a moment to take up either.
bool is_safe_until_taken_up(const Motion& motion, const Body& body, const Around& around) {
  return keeps_clear({motion.speed_mps, around.turning_radps}, body, around, around.config.takes_up_s);
}

/// The safe motion most like one that is not, in the same direction, or a part of it: a dynamic window (Fox, Burgard
/// and Thrun, "The dynamic window approach to collision avoidance", IEEE RAM 4(1), 1997) about it. A long body beside a
/// wall often gets on by a little more or less of a bend. Standing still where there is none.
Motion safe_near(const Motion& wanted, const Body& body, const Around& around) {
  const SafetyConfig& config = around.config;
  const bool turns_only = std::abs(wanted.speed_mps) < 0.01;
  const double slow_mps = turns_only ? config.slow_mps : std::copysign(config.slow_mps, wanted.speed_mps);
  const double slow_radps = std::clamp(wanted.turn_radps, -2.0 * config.bend_radps, 2.0 * config.bend_radps);
  for (int bend = 0; bend <= config.bends; ++bend) {
    for (const double side : {1.0, -1.0}) {
      const double turn_radps = slow_radps + side * bend * config.bend_radps;
      // Bending the other way would only lead away from the way.
      if (turn_radps * wanted.turn_radps < 0.0 || (turns_only && turn_radps == 0.0)) continue;
      for (const double way : {1.0, -1.0}) {
        if (way < 0.0 && !turns_only) continue;
        const Motion motion{way * slow_mps, turn_radps};
        if (is_safe(motion, body, around) && is_safe_until_taken_up(motion, body, around)) return motion;
      }
      if (bend == 0) break;
    }
  }
  if (turns_only) return {};
  // Straight on along what it is beside, or out of what its front stands before: on from there the way is looked for
  // anew.
  for (const Motion& motion : {Motion{slow_mps, 0.0}, Motion{0.0, slow_radps}}) {
    if (is_safe(motion, body, around) && is_safe_until_taken_up(motion, body, around)) return motion;
  }
  return {};
}

/// A long body keeps to the bend that was chosen for it, slower; its front may move sideways hardly faster than things
/// beside it allow it to drive.
Motion made_safe_long(const Motion& wanted, const Body& body, const Around& around, double closeness_mps) {
  const double swing_mps = std::abs(wanted.turn_radps) * swept_radius_m(body.outline);
  const double most = std::min({1.0, closeness_mps / std::max(1e-6, std::abs(wanted.speed_mps)),
                                around.config.swing * closeness_mps / std::max(1e-6, swing_mps)});
  for (const double share : {1.0, 0.75, 0.5, 0.25}) {
    const Motion slower{wanted.speed_mps * most * share, wanted.turn_radps * most * share};
    if (is_safe(slower, body, around)) return slower;
  }
  return safe_near(wanted, body, around);
}

}  // namespace

std::vector<Eigen::Vector2d> seen_after(std::span<const Eigen::Vector2d> points_m, const Motion& motion,
                                        double seconds) {
  const double turned_rad = motion.turn_radps * seconds;
  const double length_m = motion.speed_mps * seconds;
  const double half_rad = 0.5 * turned_rad;
  const double chord_m = std::abs(half_rad) < 1e-9 ? length_m : length_m * std::sin(half_rad) / half_rad;
  const Eigen::Vector2d moved_m(chord_m * std::cos(half_rad), chord_m * std::sin(half_rad));
  const double c = std::cos(turned_rad);
  const double s = std::sin(turned_rad);
  std::vector<Eigen::Vector2d> result;
  result.reserve(points_m.size());
  for (const Eigen::Vector2d& point : points_m) {
    const Eigen::Vector2d d = point - moved_m;
    result.emplace_back(c * d.x() + s * d.y(), -s * d.x() + c * d.y());
  }
  return result;
}

double clearance_m(const Body& body, std::span<const Eigen::Vector2d> points_m) {
  double nearest_m = 100.0;
  for (const Eigen::Vector2d& point : points_m) nearest_m = std::min(nearest_m, distance_m(body.outline, point));
  return nearest_m;
}

double clearance_at_m(const Body& body, std::span<const Eigen::Vector2d> points_m, const Pose2& pose) {
  const Pose2 back = inverse(pose);
  const double c = std::cos(back.theta_rad);
  const double s = std::sin(back.theta_rad);
  double nearest_m = 100.0;
  for (const Eigen::Vector2d& point : points_m) {
    const Eigen::Vector2d seen(back.x_m + c * point.x() - s * point.y(), back.y_m + s * point.x() + c * point.y());
    nearest_m = std::min(nearest_m, distance_m(body.outline, seen));
  }
  return nearest_m;
}

Motion made_safe(const Motion& wanted, const Body& body, std::span<const Eigen::Vector2d> points_m,
                 double turning_radps, const SafetyConfig& config) {
  // Far points cannot matter within one braking distance.
  std::vector<Eigen::Vector2d> near;
  for (const Eigen::Vector2d& point : points_m) {
    if (point.norm() < config.near_m) near.push_back(point);
  }
  const Around around{near, clearance_m(body, near), turning_radps, config};
  Motion motion = wanted;
  motion.speed_mps =
      std::clamp(motion.speed_mps, -std::min(config.backward_mps, body.max_speed_mps), body.max_speed_mps);
  motion.turn_radps = std::clamp(motion.turn_radps, -body.max_turn_radps, body.max_turn_radps);
  // Closeness limits speed even beside things: so much for each metre of room, but creeping is always allowed.
  const double closeness_mps =
      std::max(config.creep_mps, config.touching_mps + config.closeness_per_s * std::max(0.0, around.now_m));
  if (!is_round(body.outline)) return made_safe_long(motion, body, around, closeness_mps);
  motion.speed_mps = std::min(motion.speed_mps, closeness_mps);
  for (const double share : {1.0, 0.75, 0.5, 0.25}) {
    const Motion slower{motion.speed_mps * share, motion.turn_radps * (share < 1.0 ? std::max(share, 0.5) : 1.0)};
    if (is_safe(slower, body, around)) return slower;
  }
  const Motion turning{0.0, motion.turn_radps};
  if (is_safe(turning, body, around)) return turning;
  return {};
}

}  // namespace homeward::driving
