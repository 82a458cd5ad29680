// SPDX-License-Identifier: Apache-2.0
#include "driving/steady_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "core/angles.hpp"

namespace homeward::driving {
namespace {

constexpr std::int64_t kRemembered_ms = 500;
constexpr double kAgree_m = 0.04;  // four times the noise of a usual scanner

struct Ray {
  double bearing_rad = 0.0;  // scanner's frame
  double range_m = 0.0;
};

Eigen::Vector2d moved(const Pose2& pose, const Eigen::Vector2d& point_m) {
  const double c = std::cos(pose.theta_rad);
  const double s = std::sin(pose.theta_rad);
  return {pose.x_m + c * point_m.x() - s * point_m.y(), pose.y_m + s * point_m.x() + c * point_m.y()};
}

Ray ray_to(const Eigen::Vector2d& point_m) { return {std::atan2(point_m.y(), point_m.x()), point_m.norm()}; }

/// Points as the scanner sees them from where it is now, in the order of their bearings.
std::vector<Ray> seen_from(const Pose2& scanner, const std::vector<Eigen::Vector2d>& points_m) {
  const Pose2 to_scanner = inverse(scanner);
  std::vector<Ray> rays;
  rays.reserve(points_m.size());
  for (const Eigen::Vector2d& point : points_m) rays.push_back(ray_to(moved(to_scanner, point)));
  std::ranges::sort(rays, {}, &Ray::bearing_rad);
  return rays;
}

/// The range at a bearing, between the two rays beside it; nothing where they are farther apart than neighbours are.
std::optional<double> range_at_m(const std::vector<Ray>& rays, double bearing_rad, double step_rad) {
  if (rays.size() < 2) return std::nullopt;
  const auto above = std::ranges::upper_bound(rays, bearing_rad, {}, &Ray::bearing_rad);
  const Ray& right = above == rays.begin() ? rays.back() : *std::prev(above);
  const Ray& left = above == rays.end() ? rays.front() : *above;
  constexpr double kNeighbours = 2.0;
  const double between_rad = wrap_angle(left.bearing_rad - right.bearing_rad);
  if (between_rad < 0.0 || between_rad > kNeighbours * step_rad) return std::nullopt;
  const double share = between_rad > 0.0 ? wrap_angle(bearing_rad - right.bearing_rad) / between_rad : 0.5;
  return right.range_m + share * (left.range_m - right.range_m);
}

}  // namespace

void SteadySweep::observe(const Scan& scan, const Pose2& odometry, std::int64_t taken_ms) {
  std::erase_if(before_, [&](const Sweep& sweep) {
    return sweep.taken_ms > taken_ms || taken_ms - sweep.taken_ms > kRemembered_ms;
  });
  const std::vector<Eigen::Vector2d> newest_m = hit_points(scan);
  const Pose2 scanner = odometry * scan.robot_from_scan;
  std::vector<std::vector<Ray>> sweeps;
  for (const Sweep& sweep : before_) sweeps.push_back(seen_from(scanner, sweep.points_m));

  const Pose2 to_scanner = inverse(scan.robot_from_scan);
  points_m_.clear();
  Sweep kept{taken_ms, {}};
  for (const Eigen::Vector2d& point : newest_m) {
    kept.points_m.push_back(moved(odometry, point));
    const Eigen::Vector2d from_scanner_m = moved(to_scanner, point);
    const Ray ray = ray_to(from_scanner_m);
    double sum_m = ray.range_m;
    int agreeing = 1;
    for (const std::vector<Ray>& rays : sweeps) {
      const auto range_m = range_at_m(rays, ray.bearing_rad, std::abs(scan.angle_step_rad));
      if (!range_m || std::abs(*range_m - ray.range_m) > kAgree_m) continue;
      sum_m += *range_m;
      ++agreeing;
    }
    const double mean_m = sum_m / agreeing;
    points_m_.push_back(moved(scan.robot_from_scan, from_scanner_m * (mean_m / std::max(1e-9, ray.range_m))));
  }
  before_.push_back(std::move(kept));
}

}  // namespace homeward::driving
