// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <vector>

#include "core/angles.hpp"
#include "core/pose2.hpp"

namespace homeward::testing {

/// Points on the walls of a room round the origin, camera height 0.
inline std::vector<Eigen::Vector3d> cloud(int count, std::mt19937_64& random) {
  std::uniform_real_distribution<double> angle(-kPi, kPi);
  std::uniform_real_distribution<double> distance(1.5, 5.0);
  std::uniform_real_distribution<double> height(-1.1, 1.2);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < count; ++i) {
    const double azimuth_rad = angle(random);
    const double distance_m = distance(random);
    points.emplace_back(distance_m * std::cos(azimuth_rad), distance_m * std::sin(azimuth_rad), height(random));
  }
  return points;
}

/// How a robot sees a point, unit.
inline Eigen::Vector3d bearing_of(const Pose2& pose, const Eigen::Vector3d& point) {
  const Eigen::Vector3d from(pose.x_m, pose.y_m, 0.0);
  return (Eigen::AngleAxisd(-pose.theta_rad, Eigen::Vector3d::UnitZ()) * (point - from)).normalized();
}

inline Eigen::Vector3d any_bearing(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
}

/// A bearing with an error of so much in each direction across it.
inline Eigen::Vector3d shaken(const Eigen::Vector3d& bearing, double noise_rad, std::mt19937_64& random) {
  std::normal_distribution<double> normal(0.0, noise_rad);
  return (bearing + Eigen::Vector3d(normal(random), normal(random), normal(random))).normalized();
}

}  // namespace homeward::testing
