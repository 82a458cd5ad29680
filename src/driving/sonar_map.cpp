// SPDX-License-Identifier: Apache-2.0
#include "driving/sonar_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "core/angles.hpp"

namespace homeward::driving {
namespace {

constexpr double kApart_m = 0.03;   // between two points of an arc
constexpr int kForgetAfter = 300;   // updates: odometry drifts
constexpr int kFreeFor = 40;        // updates that what was seen to be free is taken to stay so
constexpr double kEdge_rad = 0.02;  // so near a cone's edge nothing is certain
constexpr int kRays = 360;

Eigen::Vector2d placed(const Pose2& frame, double x_m, double y_m) {
  const Pose2 at = frame * Pose2{x_m, y_m, 0.0};
  return {at.x_m, at.y_m};
}

}  // namespace

bool SonarMap::was_free(const Eigen::Vector2d& at_m) const {
  return std::ranges::any_of(free_, [&](const Free& free) {
    const double least_cosine = std::cos(free.half_cone_rad + 0.25 * kEdge_rad);
    const Eigen::Vector2d to_m = at_m - free.from_m;
    const double apart_m = to_m.norm();
    return apart_m < free.reach_m && to_m.dot(free.direction) > least_cosine * apart_m;
  });
}

std::vector<Eigen::Vector2d> SonarMap::arc(const Pose2& sonar, double range_m, double half_cone_rad) const {
  std::vector<Eigen::Vector2d> all;
  std::vector<Eigen::Vector2d> middle;
  std::vector<Eigen::Vector2d> unknown;
  std::vector<Eigen::Vector2d> unknown_middle;
  const bool near = half_cone_rad * range_m <= config_.half_arc_m;
  const int steps = std::max(1, static_cast<int>(std::ceil(half_cone_rad * range_m / kApart_m)));
  for (int i = -steps; i <= steps; ++i) {
    const double angle_rad = half_cone_rad * i / steps;
    const Eigen::Vector2d at_m = placed(sonar, range_m * std::cos(angle_rad), range_m * std::sin(angle_rad));
    all.push_back(at_m);
    if (near) continue;
    const bool is_middle = std::abs(angle_rad) * range_m <= config_.half_arc_m;
    if (is_middle) middle.push_back(at_m);
    if (was_free(at_m)) continue;
    unknown.push_back(at_m);
    if (is_middle) unknown_middle.push_back(at_m);
  }
  if (near) return all;
  if (!unknown_middle.empty()) return unknown_middle;
  return unknown.empty() ? middle : unknown;
}

Scan SonarMap::update(const std::vector<SonarReading>& readings, const Pose2& odometry) {
  ++updates_;
  std::erase_if(free_, [&](const Free& free) { return updates_ - free.update > kFreeFor; });
  std::vector<Eigen::Vector2d> arcs;
  for (const SonarReading& reading : readings) {
    const auto range_m = static_cast<double>(reading.range_m);
    const SonarCone cone = cone_of(reading);
    if (!(range_m < cone.range_max_m)) continue;
    for (const Eigen::Vector2d& at_m : arc(odometry * reading.robot_from_sonar, range_m, cone.half_cone_rad)) {
      arcs.push_back(at_m);
    }
  }
  // One point for each place; what was said just now is the newest.
  std::set<std::pair<long, long>> taken;
  std::vector<Maybe> now;
  const auto keep = [&](const Eigen::Vector2d& at_m, int since) {
    if (taken.emplace(std::lround(at_m.x() / kApart_m), std::lround(at_m.y() / kApart_m)).second)
      now.push_back({at_m, since});
  };
  for (const Eigen::Vector2d& at_m : arcs) keep(at_m, updates_);
  for (const Maybe& maybe : maybe_) {
    if (updates_ - maybe.since < kForgetAfter) keep(maybe.at_m, maybe.since);
  }
  for (const SonarReading& reading : readings) {
    const Pose2 from_odometry = inverse(odometry * reading.robot_from_sonar);
    const SonarCone cone = cone_of(reading);
    const double free_m = std::min(static_cast<double>(reading.range_m), cone.range_max_m) - config_.tolerance_m;
    if (static_cast<double>(reading.range_m) <= cone.range_min_m) continue;
    const Pose2 sonar = odometry * reading.robot_from_sonar;
    free_.push_back({{sonar.x_m, sonar.y_m},
                     {std::cos(sonar.theta_rad), std::sin(sonar.theta_rad)},
                     free_m,
                     cone.half_cone_rad,
                     updates_});
    std::erase_if(now, [&](const Maybe& maybe) {
      const Eigen::Vector2d seen_m = placed(from_odometry, maybe.at_m.x(), maybe.at_m.y());
      return seen_m.norm() < free_m && std::abs(std::atan2(seen_m.y(), seen_m.x())) < cone.half_cone_rad - kEdge_rad;
    });
  }
  const Pose2 robot_from_odometry = inverse(odometry);
  Scan scan;
  scan.ranges_m.assign(kRays, std::numeric_limits<float>::infinity());
  scan.angle_step_rad = 2.0 * kPi / kRays;
  scan.range_max_m = 2.0 * config_.range_max_m;  // what is remembered may be farther away by now than it was seen
  maybe_.clear();
  for (const Maybe& maybe : now) {
    const Eigen::Vector2d seen_m = placed(robot_from_odometry, maybe.at_m.x(), maybe.at_m.y());
    if (seen_m.norm() >= scan.range_max_m) continue;
    maybe_.push_back(maybe);
    const double ray = std::atan2(seen_m.y(), seen_m.x()) / scan.angle_step_rad;
    float& range_m = scan.ranges_m[static_cast<std::size_t>((std::lround(ray) + kRays) % kRays)];
    range_m = std::min(range_m, static_cast<float>(seen_m.norm()));
  }
  return scan;
}

}  // namespace homeward::driving
