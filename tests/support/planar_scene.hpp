// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "core/angles.hpp"
#include "core/pose2.hpp"
#include "geometry/planar_motion.hpp"

namespace homeward::testing {

/// Random points of a room around the origin, metres; heights from the floor to the ceiling seen from 1.2 m.
inline std::vector<Eigen::Vector3d> room_points(int count, std::mt19937_64& random) {
  std::uniform_real_distribution<double> across_m(-5.0, 5.0);
  std::uniform_real_distribution<double> height_m(-1.2, 1.3);
  std::vector<Eigen::Vector3d> points;
  while (static_cast<int>(points.size()) < count) {
    const Eigen::Vector3d point(across_m(random), across_m(random), height_m(random));
    if (point.head<2>().norm() > 2.0) points.push_back(point);
  }
  return points;
}

/// The bearing of a point in the frame of a robot at `world_from_robot`.
inline Eigen::Vector3d bearing_from(const Pose2& world_from_robot, const Eigen::Vector3d& point) {
  const double c = std::cos(world_from_robot.theta_rad);
  const double s = std::sin(world_from_robot.theta_rad);
  const double dx_m = point.x() - world_from_robot.x_m;
  const double dy_m = point.y() - world_from_robot.y_m;
  return Eigen::Vector3d(c * dx_m + s * dy_m, -s * dx_m + c * dy_m, point.z()).normalized();
}

/// A bearing turned by an angle of normal distribution about a random axis.
inline Eigen::Vector3d with_noise(const Eigen::Vector3d& bearing, double spread_rad, std::mt19937_64& random) {
  std::normal_distribution<double> noise(0.0, spread_rad);
  return (bearing + Eigen::Vector3d(noise(random), noise(random), noise(random))).normalized();
}

struct PlanarScene {
  geometry::PlanarMotion truth;
  std::vector<geometry::Correspondence> correspondences;
  std::vector<bool> outlier;
};

/// Two views of one room `distance_m` apart; a share of the matches is wrong.
inline PlanarScene planar_scene(int count, double outlier_share, double noise_rad, double distance_m,
                                std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> angle_rad(-kPi, kPi);
  PlanarScene scene;
  scene.truth = {angle_rad(random), angle_rad(random)};
  const Pose2 current_from_target{distance_m * std::cos(scene.truth.direction_rad),
                                  distance_m * std::sin(scene.truth.direction_rad), scene.truth.turn_rad};
  const auto points = room_points(count, random);
  const auto others = room_points(count, random);
  for (int i = 0; i < count; ++i) {
    const auto index = static_cast<std::size_t>(i);
    const bool wrong = i < static_cast<int>(std::lround(outlier_share * count));
    scene.outlier.push_back(wrong);
    scene.correspondences.push_back(
        {with_noise(bearing_from({}, points[index]), noise_rad, random),
         with_noise(bearing_from(current_from_target, wrong ? others[index] : points[index]), noise_rad, random)});
  }
  return scene;
}

/// How far a direction is from the true one, whichever way round.
inline double direction_error_deg(const geometry::PlanarMotion& found, const geometry::PlanarMotion& truth) {
  return std::abs(degrees(wrap_angle(found.direction_rad - truth.direction_rad)));
}

}  // namespace homeward::testing
