// SPDX-License-Identifier: Apache-2.0
#include "driving/scan.hpp"

#include <cmath>

#include "core/angles.hpp"

namespace homeward::driving {

std::vector<Eigen::Vector2d> hit_points(const Scan& scan) {
  std::vector<Eigen::Vector2d> points;
  points.reserve(scan.ranges_m.size());
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const auto range_m = static_cast<double>(scan.ranges_m[i]);
    if (!std::isfinite(range_m) || range_m <= 0.0 || range_m >= scan.range_max_m) continue;
    const double angle_rad =
        scan.robot_from_scan.theta_rad + scan.angle_min_rad + static_cast<double>(i) * scan.angle_step_rad;
    points.emplace_back(scan.robot_from_scan.x_m + range_m * std::cos(angle_rad),
                        scan.robot_from_scan.y_m + range_m * std::sin(angle_rad));
  }
  return points;
}

bool looks_behind(const Scan& scan) {
  constexpr double kAside_rad = kPi / 3.0;
  const double step_rad = std::abs(scan.angle_step_rad);
  const double seen_rad = step_rad * static_cast<double>(scan.ranges_m.size());
  if (scan.ranges_m.empty() || step_rad > 0.2) return false;
  if (seen_rad > 2.0 * kPi - 2.0 * step_rad) return true;
  // Half a step beyond the outermost rays counts as seen.
  const double middle_rad = scan.robot_from_scan.theta_rad + scan.angle_min_rad +
                            0.5 * scan.angle_step_rad * static_cast<double>(scan.ranges_m.size() - 1);
  return std::abs(wrap_angle(kPi - middle_rad)) + kAside_rad <= 0.5 * seen_rad;
}

}  // namespace homeward::driving
