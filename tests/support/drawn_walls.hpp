// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/pose2.hpp"
#include "core/range_sweep.hpp"

namespace homeward::testing {

/// A straight wall of a plan that a test draws.
struct DrawnWall {
  Eigen::Vector2d from_m;
  Eigen::Vector2d to_m;
};

inline void add_box(std::vector<DrawnWall>& walls, double left_m, double low_m, double right_m, double high_m) {
  const Eigen::Vector2d a(left_m, low_m);
  const Eigen::Vector2d b(right_m, low_m);
  const Eigen::Vector2d c(right_m, high_m);
  const Eigen::Vector2d d(left_m, high_m);
  walls.insert(walls.end(), {{a, b}, {b, c}, {c, d}, {d, a}});
}

/// Two rooms of 5 m x 4 m beside each other with a door of 1 m between them, and a box in the second one.
inline std::vector<DrawnWall> two_rooms() {
  std::vector<DrawnWall> walls;
  add_box(walls, 0.0, 0.0, 10.0, 4.0);
  walls.push_back({{5.0, 0.0}, {5.0, 1.5}});
  walls.push_back({{5.0, 2.5}, {5.0, 4.0}});
  add_box(walls, 7.5, 0.0, 8.5, 1.2);
  return walls;
}

/// What a scanner of 360 rays sees of them, without noise.
inline RangeSweep sweep_of(const std::vector<DrawnWall>& walls, const Pose2& pose) {
  RangeSweep sweep;
  sweep.angle_step_rad = 2.0 * std::numbers::pi / 360.0;
  sweep.range_max_m = 12.0;
  for (int i = 0; i < 360; ++i) {
    const double angle_rad = pose.theta_rad + i * sweep.angle_step_rad;
    const Eigen::Vector2d ray(std::cos(angle_rad), std::sin(angle_rad));
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const DrawnWall& wall : walls) {
      const Eigen::Vector2d along = wall.to_m - wall.from_m;
      const Eigen::Vector2d off = wall.from_m - position_m(pose);
      const double cross = ray.x() * along.y() - ray.y() * along.x();
      if (std::abs(cross) < 1e-12) continue;
      const double range_m = (off.x() * along.y() - off.y() * along.x()) / cross;
      const double share = (off.x() * ray.y() - off.y() * ray.x()) / cross;
      if (range_m > 0.0 && share >= 0.0 && share <= 1.0) nearest_m = std::min(nearest_m, range_m);
    }
    sweep.ranges_m.push_back(static_cast<float>(nearest_m));
  }
  return sweep;
}

/// Two rooms with two doors between them: a way round.
inline std::vector<DrawnWall> rooms_with_two_doors() {
  std::vector<DrawnWall> walls;
  add_box(walls, 0.0, 0.0, 10.0, 4.0);
  walls.push_back({{5.0, 1.4}, {5.0, 2.6}});
  add_box(walls, 1.9, 1.6, 3.1, 2.4);
  add_box(walls, 6.8, 1.7, 8.2, 2.3);
  return walls;
}

}  // namespace homeward::testing
