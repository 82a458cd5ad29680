// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "core/angles.hpp"

namespace homeward {

/// Position and heading of a robot on the floor; or, as `a_from_b`, the planar rigid transform from frame b to a.
/// Heading counter-clockwise from +x, (-pi, pi].
struct Pose2 {
  double x_m = 0.0;
  double y_m = 0.0;
  double theta_rad = 0.0;
};

/// Where it is, without its heading.
inline Eigen::Vector2d position_m(const Pose2& pose) { return {pose.x_m, pose.y_m}; }

/// a_from_c = a_from_b * b_from_c
inline Pose2 operator*(const Pose2& a_from_b, const Pose2& b_from_c) {
  const double c = std::cos(a_from_b.theta_rad);
  const double s = std::sin(a_from_b.theta_rad);
  return {a_from_b.x_m + c * b_from_c.x_m - s * b_from_c.y_m, a_from_b.y_m + s * b_from_c.x_m + c * b_from_c.y_m,
          wrap_angle(a_from_b.theta_rad + b_from_c.theta_rad)};
}

inline Pose2 inverse(const Pose2& a_from_b) {
  const double c = std::cos(a_from_b.theta_rad);
  const double s = std::sin(a_from_b.theta_rad);
  return {-c * a_from_b.x_m - s * a_from_b.y_m, s * a_from_b.x_m - c * a_from_b.y_m, wrap_angle(-a_from_b.theta_rad)};
}

}  // namespace homeward
