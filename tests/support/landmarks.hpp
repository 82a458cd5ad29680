// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <random>
#include <vector>

#include "features/appearance.hpp"
#include "support/planar_scene.hpp"

namespace homeward::testing {

/// Points of a building with a descriptor each: what a camera sees of it from any pose, without pictures.
struct Landmarks {
  std::vector<Eigen::Vector3d> points_m;  // relative to the height of the camera
  Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 128, Eigen::RowMajor> descriptors;
};

/// `count` landmarks around a way, none nearer to it than `clear_m` and none farther than `reach_m`.
inline Landmarks landmarks_around(const std::vector<Pose2>& way, int count, std::uint64_t seed, double clear_m = 1.5,
                                  double reach_m = 5.0) {
  std::mt19937_64 random(seed);
  double low_m = 1e9;
  double high_m = -1e9;
  for (const Pose2& pose : way) {
    low_m = std::min({low_m, pose.x_m, pose.y_m});
    high_m = std::max({high_m, pose.x_m, pose.y_m});
  }
  std::uniform_real_distribution<double> across_m(low_m - reach_m, high_m + reach_m);
  std::uniform_real_distribution<double> height_m(-1.1, 1.2);
  std::uniform_int_distribution<int> byte(0, 255);
  Landmarks landmarks;
  while (static_cast<int>(landmarks.points_m.size()) < count) {
    const Eigen::Vector3d point(across_m(random), across_m(random), height_m(random));
    double nearest_m = 1e9;
    for (const Pose2& pose : way) {
      nearest_m = std::min(nearest_m, std::hypot(point.x() - pose.x_m, point.y() - pose.y_m));
    }
    if (nearest_m > clear_m && nearest_m < reach_m) landmarks.points_m.push_back(point);
  }
  landmarks.descriptors.resize(count, 128);
  for (int i = 0; i < count; ++i) {
    for (int d = 0; d < 128; ++d) landmarks.descriptors(i, d) = static_cast<std::uint8_t>(byte(random));
  }
  return landmarks;
}

/// What is seen from a pose: bearings with noise of 0.1 degrees, descriptors a little changed, and a share of them that
/// belongs to nothing.
inline features::Appearance seen_from(const Landmarks& landmarks, const Pose2& pose, std::uint64_t seed,
                                      double foreign_share = 0.0) {
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<int> byte(0, 255);
  std::uniform_int_distribution<int> change(-6, 6);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const auto count = static_cast<Eigen::Index>(landmarks.points_m.size());
  features::Appearance appearance;
  features::FeatureSet& sift = appearance.sift;
  sift.bearings.resize(count, 3);
  sift.scales_rad = Eigen::VectorXf::Constant(count, 0.03F);
  sift.descriptors.resize(count, 128);
  sift.colours.setZero(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::Vector3d bearing = bearing_from(pose, landmarks.points_m[static_cast<std::size_t>(i)]);
    sift.bearings.row(i) = with_noise(bearing, radians(0.1), random).cast<float>();
    const bool foreign = share(random) < foreign_share;
    for (int d = 0; d < 128; ++d) {
      const int value = foreign ? byte(random) : landmarks.descriptors(i, d) + change(random);
      sift.descriptors(i, d) = static_cast<std::uint8_t>(std::clamp(value, 0, 255));
    }
  }
  return appearance;
}

}  // namespace homeward::testing
