// SPDX-License-Identifier: Apache-2.0
#include "agent/drivers/range_ring.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/angles.hpp"

namespace homeward::agent {
namespace {

constexpr driving::Milliseconds kOldest_ms = 400;  // no more than the agent bears without sweeps
constexpr double kGap_rad = radians(5.0);          // beside a cone, which counts as covered
constexpr double kBehind_rad = kPi / 3.0;          // to both sides of straight back
constexpr double kAhead_rad = kPi / 6.0;           // and of straight ahead

driving::SonarMap map_of(const std::vector<wire::RosRangeSensor>& sensors) {
  driving::SonarConfig config;
  config.range_max_m = 0.0;
  for (const wire::RosRangeSensor& sensor : sensors)
    config.range_max_m = std::max(config.range_max_m, sensor.range_max_m);
  return driving::SonarMap(config);
}

bool is_covered(const std::vector<wire::RosRangeSensor>& sensors, double direction_rad) {
  return std::ranges::any_of(sensors, [&](const wire::RosRangeSensor& sensor) {
    return std::abs(wrap_angle(direction_rad - sensor.robot_from_sensor.theta_rad)) <= 0.5 * sensor.cone_rad + kGap_rad;
  });
}

/// Whether all directions so far to both sides of one are covered.
bool covers_sector(const std::vector<wire::RosRangeSensor>& sensors, double direction_rad, double aside_rad) {
  const auto most = static_cast<int>(std::floor(degrees(aside_rad) + 1e-6));
  for (int degree = -most; degree <= most; ++degree) {
    if (!is_covered(sensors, direction_rad + radians(degree))) return false;
  }
  return true;
}

/// Points of the robot frame as a sweep about its turning point, the nearest in each direction.
driving::Scan about_the_robot(const std::vector<Eigen::Vector2d>& points_m, int rays_per_turn, double range_max_m,
                              bool behind) {
  driving::Scan scan;
  scan.angle_step_rad = 2.0 * kPi / rays_per_turn;
  scan.range_max_m = range_max_m;
  const int half =
      behind ? rays_per_turn / 2 : static_cast<int>(std::lround((kPi - kBehind_rad) / scan.angle_step_rad));
  const int rays = behind ? rays_per_turn : 2 * half + 1;
  scan.angle_min_rad = -half * scan.angle_step_rad;
  scan.ranges_m.assign(static_cast<std::size_t>(rays), std::numeric_limits<float>::infinity());
  for (const Eigen::Vector2d& at_m : points_m) {
    auto ray = static_cast<int>(std::lround(std::atan2(at_m.y(), at_m.x()) / scan.angle_step_rad)) + half;
    if (behind) ray = (ray + rays_per_turn) % rays_per_turn;
    if (ray < 0 || ray >= rays) continue;
    float& range_m = scan.ranges_m[static_cast<std::size_t>(ray)];
    range_m = std::min(range_m, static_cast<float>(at_m.norm()));
  }
  return scan;
}

}  // namespace

RangeRing::RangeRing(std::vector<wire::RosRangeSensor> sensors)
    : sensors_(std::move(sensors)), map_(map_of(sensors_)), latest_(sensors_.size()) {
  covers_behind_ = covers_sector(sensors_, kPi, kBehind_rad);
}

bool RangeRing::covers_ahead() const { return covers_sector(sensors_, 0.0, kAhead_rad); }

int RangeRing::uncovered_deg() const {
  int count = 0;
  for (int degree = 0; degree < 360; ++degree) count += is_covered(sensors_, radians(degree)) ? 0 : 1;
  return count;
}

void RangeRing::add(const RosRange& range, driving::Milliseconds now, const Pose2& odometry) {
  latest_[range.sensor] = Reading{range, now, odometry};
}

std::optional<RingSweep> RangeRing::sweep(driving::Milliseconds now, const Pose2& odometry) {
  RingSweep sweep{{}, now, odometry};
  std::vector<driving::SonarReading> readings;
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    if (!latest_[i] || now - latest_[i]->at_ms > kOldest_ms) return std::nullopt;
    sweep.taken_ms = std::min(sweep.taken_ms, latest_[i]->at_ms);
    // The robot has moved since.
    const Pose2 robot_from_sonar = inverse(odometry) * (latest_[i]->odometry * sensors_[i].robot_from_sensor);
    readings.push_back(
        {robot_from_sonar, latest_[i]->range.range_m,
         driving::SonarCone{0.5 * sensors_[i].cone_rad, static_cast<double>(latest_[i]->range.range_min_m),
                            sensors_[i].range_max_m}});
  }
  if (readings.empty()) return std::nullopt;
  sweep.scan = map_.update(readings, odometry);
  if (!covers_behind_) {
    sweep.scan = about_the_robot(driving::hit_points(sweep.scan), static_cast<int>(sweep.scan.ranges_m.size()),
                                 sweep.scan.range_max_m, false);
  }
  latest_.assign(sensors_.size(), std::nullopt);
  return sweep;
}

void RangeRing::forget() {
  map_ = map_of(sensors_);
  latest_.assign(sensors_.size(), std::nullopt);
}

driving::Scan with_ring(const driving::Scan& scan, const RingSweep& ring, const Pose2& robot) {
  constexpr int kRaysPerTurn = 720;
  std::vector<Eigen::Vector2d> points_m = driving::hit_points(scan);
  const Pose2 robot_from_then = inverse(robot) * ring.odometry;
  for (const Eigen::Vector2d& then_m : driving::hit_points(ring.scan)) {
    const Pose2 now = robot_from_then * Pose2{then_m.x(), then_m.y(), 0.0};
    points_m.emplace_back(now.x_m, now.y_m);
  }
  double farthest_m = 0.0;
  for (const Eigen::Vector2d& at_m : points_m) farthest_m = std::max(farthest_m, at_m.norm());
  // Seen from the turning point a return may lie farther off than the scanner reaches.
  const double range_max_m = std::max({scan.range_max_m, ring.scan.range_max_m, farthest_m + 0.01});
  return about_the_robot(points_m, kRaysPerTurn, range_max_m,
                         driving::looks_behind(scan) || driving::looks_behind(ring.scan));
}

}  // namespace homeward::agent
