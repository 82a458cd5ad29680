// SPDX-License-Identifier: Apache-2.0
#include "driving/steering.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "core/angles.hpp"
#include "driving/local_path.hpp"

namespace homeward::driving {
namespace {

std::vector<Eigen::Vector2d> points_within(std::span<const Eigen::Vector2d> points_m, double distance_m) {
  std::vector<Eigen::Vector2d> near;
  std::ranges::copy_if(points_m, std::back_inserter(near),
                       [&](const Eigen::Vector2d& point) { return point.norm() < distance_m; });
  return near;
}

/// How much room is wanting on the way straight ahead after turning by an angle; 0: none.
double shortfall_m(const Body& body, std::span<const Eigen::Vector2d> near_m, double angle_rad, double now_m,
                   const SteeringConfig& config) {
  const Eigen::Rotation2Dd turned(-angle_rad);
  double worst_m = 0.0;
  std::vector<Eigen::Vector2d> then(near_m.size());
  for (double along_m = 0.25 * config.look_m; along_m <= config.look_m + 1e-9; along_m += 0.25 * config.look_m) {
    std::ranges::transform(near_m, then.begin(), [&](const Eigen::Vector2d& point) -> Eigen::Vector2d {
      return turned * point - Eigen::Vector2d(along_m, 0.0);
    });
    const double wanted_m = std::min(config.enough_m, now_m + config.outwards * along_m);
    worst_m = std::max(worst_m, wanted_m - clearance_m(body, then));
  }
  return worst_m;
}

/// The heading nearest to the wanted one along which there will be more room; the least bad where there is none.
double heading_with_room(const Body& body, std::span<const Eigen::Vector2d> points_m, double wanted_rad,
                         const SteeringConfig& config) {
  const std::vector<Eigen::Vector2d> near = points_within(points_m, config.near_m);
  const double now_m = clearance_m(body, near);
  if (now_m >= config.close_m) return wanted_rad;
  double best_rad = wanted_rad;
  double least_m = shortfall_m(body, near, wanted_rad, now_m, config);
  for (double off_rad = config.heading_step_rad; off_rad < kPi && least_m > 0.0; off_rad += config.heading_step_rad) {
    for (const double angle_rad : {wanted_rad + off_rad, wanted_rad - off_rad}) {
      const double wanting_m = shortfall_m(body, near, angle_rad, now_m, config);
      if (wanting_m >= least_m) continue;
      least_m = wanting_m;
      best_rad = angle_rad;
    }
  }
  return wrap_angle(best_rad);
}

/// How much room there is at least on so much of an arc; of a straight line where `turn_radps` is 0.
double room_on_arc_m(const Body& body, std::span<const Eigen::Vector2d> near_m, const Motion& motion, double seconds,
                     double step_s) {
  double least_m = clearance_m(body, near_m);
  for (double t_s = step_s; t_s < seconds + 1e-9; t_s += step_s) {
    least_m = std::min(least_m, clearance_m(body, seen_after(near_m, motion, t_s)));
  }
  return least_m;
}

/// As fast as leaves the body room while it still turns: an arc begun too early cuts the corner that the way goes
/// round. What the way itself leaves, once the robot is turned to it by `angle_rad`, is room enough.
double speed_with_room_mps(const Body& body, std::span<const Eigen::Vector2d> points_m, const Motion& motion,
                           double angle_rad, const SteeringConfig& config) {
  const std::vector<Eigen::Vector2d> near = points_within(points_m, config.near_m);
  const std::vector<Eigen::Vector2d> turned = seen_after(near, {0.0, angle_rad}, 1.0);
  const double wanted_m =
      std::min(config.enough_m, room_on_arc_m(body, turned, {motion.speed_mps, 0.0}, config.look_s, config.step_s)) -
      config.alike_m;
  for (const double share : {1.0, 0.5, 0.25}) {
    const Motion slower{share * motion.speed_mps, motion.turn_radps};
    if (room_on_arc_m(body, near, slower, config.look_s, config.step_s) >= wanted_m) return slower.speed_mps;
  }
  return 0.0;
}

}  // namespace

Motion steer_round(const Body& body, std::span<const Eigen::Vector2d> points_m, const Eigen::Vector2d& goal_m,
                   double heading_rad, double speed_mps, double turn_gain, const SteeringConfig& config) {
  const auto way = local_way(body, points_m, goal_m, heading_rad);
  if (!way) return {};
  // So long a way round leads through what no sweep has seen, behind walls mostly: whoever stands before the robot is
  // waited for.
  if (!body.vague_ranges && way->length_m > config.longest_share * goal_m.norm() + config.longer_m) return {};
  const double angle_rad = heading_with_room(body, points_m, std::atan2(way->carrot_m.y(), way->carrot_m.x()), config);
  const double turn_radps = std::clamp(turn_gain * angle_rad, -body.max_turn_radps, body.max_turn_radps);
  if (std::abs(angle_rad) > config.turn_first_rad) return {0.0, turn_radps};
  const double straightness = std::cos(angle_rad * 1.57 / config.turn_first_rad);
  const Motion motion{speed_mps * std::max(config.slowest_share, straightness), turn_radps};
  return {speed_with_room_mps(body, points_m, motion, angle_rad, config), turn_radps};
}

Motion steer_round(LongPlan& plan, const Body& body, std::span<const Eigen::Vector2d> points_m,
                   const Eigen::Vector2d& goal_m, const Pose2& odometry, double speed_mps, double turn_gain,
                   const SteeringConfig& config) {
  if (is_round(body.outline))
    return steer_round(body, points_m, goal_m, odometry.theta_rad, speed_mps, turn_gain, config);
  return steer_long(plan, body, points_m, goal_m, odometry, speed_mps, turn_gain, config.long_plan);
}

}  // namespace homeward::driving
