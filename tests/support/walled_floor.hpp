// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <vector>

#include "core/angles.hpp"
#include "core/range_sweep.hpp"

namespace homeward::testing {

/// A wall from one point of the floor to another.
struct Wall {
  Eigen::Vector2d from_m;
  Eigen::Vector2d to_m;
};

/// The four walls of a room.
inline std::vector<Wall> walls_around(const Eigen::Vector2d& low_m, const Eigen::Vector2d& high_m) {
  const Eigen::Vector2d right(high_m.x(), low_m.y());
  const Eigen::Vector2d left(low_m.x(), high_m.y());
  return {{low_m, right}, {right, high_m}, {high_m, left}, {left, low_m}};
}

/// What a scanner at a pose sees of walls: a ray a degree, all around, infinity where there is none within 12 m.
inline RangeSweep sweep_at(const Pose2& pose, const std::vector<Wall>& walls) {
  constexpr int kRays = 360;
  RangeSweep sweep;
  sweep.angle_step_rad = 2.0 * kPi / kRays;
  const Eigen::Vector2d here_m(pose.x_m, pose.y_m);
  for (int i = 0; i < kRays; ++i) {
    const double angle_rad = pose.theta_rad + sweep.angle_step_rad * i;
    const Eigen::Vector2d ray(std::cos(angle_rad), std::sin(angle_rad));
    double range_m = std::numeric_limits<double>::infinity();
    for (const Wall& wall : walls) {
      Eigen::Matrix2d axes;
      axes << ray, wall.from_m - wall.to_m;
      if (std::abs(axes.determinant()) < 1e-12) continue;
      const Eigen::Vector2d met = axes.inverse() * (wall.from_m - here_m);
      const bool on_wall = met.x() > 0.0 && met.y() >= 0.0 && met.y() <= 1.0;
      if (on_wall && met.x() < sweep.range_max_m) range_m = std::min(range_m, met.x());
    }
    sweep.ranges_m.push_back(static_cast<float>(range_m));
  }
  return sweep;
}

}  // namespace homeward::testing
