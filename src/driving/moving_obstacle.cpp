// SPDX-License-Identifier: Apache-2.0
#include "driving/moving_obstacle.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/angles.hpp"

namespace homeward::driving {
namespace {

constexpr std::int64_t kApart_ms = 1000;  // two sweeps that are compared
constexpr double kStands_m = 0.05;        // farther apart they show other sides of things
constexpr double kNear_m = 3.0;           // what moves farther off does not stand in the way
constexpr double kNearer_m = 0.4;         // than what was seen there: more than noise
constexpr double kWidth_m = 0.1;          // of what counts, at least,
constexpr int kRays = 4;                  // and in rays
constexpr double kFinest_rad = 1e-4;      // no scanner has finer rays

/// How far the sweep looked about a direction: the least of three neighbouring rays, so that an edge that lies half a
/// ray off is none that moved; 0 where it did not look.
double looked_m(const Scan& scan, double angle_rad) {
  double from_first_rad = std::fmod(angle_rad - scan.angle_min_rad, 2.0 * kPi);
  if (from_first_rad * scan.angle_step_rad < 0.0) from_first_rad += std::copysign(2.0 * kPi, scan.angle_step_rad);
  const double ray = std::round(from_first_rad / scan.angle_step_rad);
  double least_m = scan.range_max_m;
  for (int beside = -1; beside <= 1; ++beside) {
    const auto index = static_cast<std::ptrdiff_t>(ray) + beside;
    const auto rays = static_cast<std::ptrdiff_t>(scan.ranges_m.size());
    const bool around = std::abs(scan.angle_step_rad) * static_cast<double>(rays) > 2.0 * kPi - 1e-3;
    if (!around && (index < 0 || index >= rays)) return 0.0;
    const float range_m = scan.ranges_m[static_cast<std::size_t>(((index % rays) + rays) % rays)];
    if (std::isnan(range_m)) return 0.0;  // an infinite range looked through, this one failed
    if (std::isfinite(range_m)) least_m = std::min(least_m, static_cast<double>(range_m));
  }
  return least_m;
}

/// Whether neighbouring rays of a sweep, enough of them, end where the one before looked through. `to_before`: the pose
/// of the robot now in its frame then.
bool something_came(const Scan& before, const Scan& now, const Pose2& to_before) {
  const Pose2 scanner = inverse(before.robot_from_scan) * to_before * now.robot_from_scan;
  int run = 0;
  double width_m = 0.0;
  for (std::size_t i = 0; i < now.ranges_m.size(); ++i) {
    const auto range_m = static_cast<double>(now.ranges_m[i]);
    bool came = false;
    if (std::isfinite(range_m) && range_m > 0.0 && range_m < kNear_m) {
      const double angle_rad = now.angle_min_rad + static_cast<double>(i) * now.angle_step_rad;
      const Pose2 point = scanner * Pose2{range_m * std::cos(angle_rad), range_m * std::sin(angle_rad), 0.0};
      const double then_m = std::hypot(point.x_m, point.y_m);
      came = looked_m(before, std::atan2(point.y_m, point.x_m)) - then_m > kNearer_m;
    }
    run = came ? run + 1 : 0;
    width_m = came ? width_m + range_m * std::abs(now.angle_step_rad) : 0.0;
    if (run >= kRays && width_m >= kWidth_m) return true;
  }
  return false;
}

}  // namespace

void watch(MovingObstacle& state, const Scan& scan, const Pose2& odometry, std::int64_t now_ms) {
  if (state.before) {
    const Pose2 to_before = inverse(state.before_from) * odometry;
    const bool stands = std::hypot(to_before.x_m, to_before.y_m) < kStands_m;
    if (stands && now_ms - state.before_ms < kApart_ms) return;
    const bool comparable = stands && std::abs(state.before->angle_step_rad) > kFinest_rad;
    if (comparable && something_came(*state.before, scan, to_before)) state.seen_ms = now_ms;
  }
  state.before = scan;
  state.before_from = odometry;
  state.before_ms = now_ms;
}

}  // namespace homeward::driving
