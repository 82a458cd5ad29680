// SPDX-License-Identifier: Apache-2.0
#include "agent/driving/sonar_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "core/angles.hpp"

namespace homeward::agent {
namespace {

constexpr double kApart_m = 0.03;   // between two points of an arc
constexpr int kForgetAfter = 300;   // updates: odometry drifts
constexpr double kEdge_rad = 0.02;  // so near a cone's edge nothing is certain
constexpr int kRays = 360;

Eigen::Vector2d placed(const Pose2& frame, double x_m, double y_m) {
  const Pose2 at = frame * Pose2{x_m, y_m, 0.0};
  return {at.x_m, at.y_m};
}

}  // namespace

Scan SonarMap::update(const std::vector<SonarReading>& readings, const Pose2& odometry) {
  ++updates_;
  std::vector<Eigen::Vector2d> arcs;
  for (const SonarReading& reading : readings) {
    const auto range_m = static_cast<double>(reading.range_m);
    if (!(range_m < config_.range_max_m)) continue;
    const Pose2 sonar = odometry * reading.robot_from_sonar;
    const double half_rad = std::min(config_.half_cone_rad, config_.half_arc_m / range_m);
    const int steps = std::max(1, static_cast<int>(std::ceil(half_rad * range_m / kApart_m)));
    for (int i = -steps; i <= steps; ++i) {
      const double angle_rad = half_rad * i / steps;
      arcs.push_back(placed(sonar, range_m * std::cos(angle_rad), range_m * std::sin(angle_rad)));
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
    const double free_m = std::min(static_cast<double>(reading.range_m), config_.range_max_m) - config_.tolerance_m;
    if (static_cast<double>(reading.range_m) <= config_.range_min_m) continue;
    std::erase_if(now, [&](const Maybe& maybe) {
      const Eigen::Vector2d seen_m = placed(from_odometry, maybe.at_m.x(), maybe.at_m.y());
      return seen_m.norm() < free_m && std::abs(std::atan2(seen_m.y(), seen_m.x())) < config_.half_cone_rad - kEdge_rad;
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

}  // namespace homeward::agent
