// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <random>
#include <vector>

#include "geometry/five_point.hpp"
#include "geometry/seen_point.hpp"

namespace homeward::testing {

constexpr double kPinholeFocal_px = 229.0;  // 70 degrees across 320 pixels
constexpr double kPinholeHalfWidth_px = 160.0;
constexpr double kPinholeHalfHeight_px = 120.0;

/// A point at pixels right and down of the middle of a pinhole's picture; the axis is the frame's x, left y, up z.
inline geometry::SeenPoint pinhole_point(const Eigen::Vector2d& from_middle_px) {
  const Eigen::Vector3d ray(1.0, -from_middle_px.x() / kPinholeFocal_px, -from_middle_px.y() / kPinholeFocal_px);
  geometry::SeenPoint seen;
  seen.bearing = ray.normalized();
  Eigen::Matrix<double, 3, 2> ray_per_px = Eigen::Matrix<double, 3, 2>::Zero();
  ray_per_px(1, 0) = -1.0 / kPinholeFocal_px;
  ray_per_px(2, 1) = -1.0 / kPinholeFocal_px;
  seen.bearing_per_px =
      (Eigen::Matrix3d::Identity() - seen.bearing * seen.bearing.transpose()) / ray.norm() * ray_per_px;
  return seen;
}

inline Eigen::Vector2d pinhole_pixel(const Eigen::Vector3d& point) {
  return {-kPinholeFocal_px * point.y() / point.x(), -kPinholeFocal_px * point.z() / point.x()};
}

struct PinholeScene {
  std::vector<geometry::PointPair> pairs;
  std::vector<Eigen::Vector3d> points;  // in the current view's frame
  std::vector<bool> is_wrong;
};

struct PinholeSceneOptions {
  int count = 120;
  double wrong_share = 0.0;
  double noise_px = 0.2;
  double baseline = 0.4;  // metres, along `motion`'s direction
  double nearest = 2.0;   // metres
  double farthest = 6.0;
  std::uint64_t seed = 1;
};

/// Points that both views see, from `nearest` to `farthest` in front of the current one; the wrong ones are seen
/// somewhere else in the target view.
inline PinholeScene pinhole_scene(const geometry::ViewMotion& motion, const PinholeSceneOptions& options) {
  std::mt19937_64 random(options.seed);
  std::uniform_real_distribution<double> across(-kPinholeHalfWidth_px, kPinholeHalfWidth_px);
  std::uniform_real_distribution<double> down(-kPinholeHalfHeight_px, kPinholeHalfHeight_px);
  std::uniform_real_distribution<double> away(options.nearest, options.farthest);
  std::normal_distribution<double> noise(0.0, 1.0);
  PinholeScene scene;
  const auto inside = [](const Eigen::Vector2d& pixel) {
    return std::abs(pixel.x()) < kPinholeHalfWidth_px && std::abs(pixel.y()) < kPinholeHalfHeight_px;
  };
  while (static_cast<int>(scene.pairs.size()) < options.count) {
    const Eigen::Vector2d seen_px(across(random), down(random));
    const Eigen::Vector3d point = away(random) * pinhole_point(seen_px).bearing;
    const Eigen::Vector3d moved =
        motion.current_from_target.transpose() * (point - options.baseline * motion.target_in_current);
    if (moved.x() < 0.1 || !inside(pinhole_pixel(moved))) continue;
    const bool wrong = static_cast<double>(scene.pairs.size()) < options.wrong_share * options.count;
    const Eigen::Vector2d moved_px = wrong ? Eigen::Vector2d(across(random), down(random)) : pinhole_pixel(moved);
    const auto noisy = [&](const Eigen::Vector2d& pixel) {
      return pinhole_point(pixel + options.noise_px * Eigen::Vector2d(noise(random), noise(random)));
    };
    scene.pairs.push_back({noisy(seen_px), noisy(moved_px)});
    scene.points.push_back(point);
    scene.is_wrong.push_back(wrong);
  }
  return scene;
}

}  // namespace homeward::testing
