// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "camera/camera.hpp"
#include "camera/panorama.hpp"
#include "core/pose2.hpp"

namespace homeward::testing {

/// A box whose walls, floor and ceiling are painted with blotches of colour; another seed, another painting. The origin
/// is in the middle at the height of the camera.
struct PaintedRoom {
  double half_length_m = 4.0;  // along x
  double half_width_m = 3.0;   // along y
  double ceiling_m = 1.4;
  double floor_m = -1.2;
  std::uint64_t seed = 1;
};

namespace detail {

/// A number in [0,1) that depends on all arguments and looks random (SplitMix64's finaliser).
inline double hashed(std::uint64_t seed, std::int64_t a, std::int64_t b) {
  std::uint64_t x = seed * 0x9E3779B97F4A7C15ULL + static_cast<std::uint64_t>(a) * 0xBF58476D1CE4E5B9ULL +
                    static_cast<std::uint64_t>(b) * 0x94D049BB133111EBULL;
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBULL;
  return static_cast<double>((x ^ (x >> 31U)) >> 11U) / 9007199254740992.0;
}

/// Random values on a square grid, interpolated.
inline double blotches(std::uint64_t seed, double a, double b) {
  const double fa = std::floor(a);
  const double fb = std::floor(b);
  const auto ia = static_cast<std::int64_t>(fa);
  const auto ib = static_cast<std::int64_t>(fb);
  const double s = a - fa;
  const double t = b - fb;
  const double low = (1.0 - s) * hashed(seed, ia, ib) + s * hashed(seed, ia + 1, ib);
  const double high = (1.0 - s) * hashed(seed, ia, ib + 1) + s * hashed(seed, ia + 1, ib + 1);
  return (1.0 - t) * low + t * high;
}

}  // namespace detail

/// What is seen from (x, y) in a direction of the world.
inline std::array<std::uint8_t, 3> painted(const PaintedRoom& room, double x_m, double y_m,
                                           const Eigen::Vector3d& direction) {
  const Eigen::Vector3d from(x_m, y_m, 0.0);
  const std::array<double, 3> high = {room.half_length_m, room.half_width_m, room.ceiling_m};
  const std::array<double, 3> low = {-room.half_length_m, -room.half_width_m, room.floor_m};
  double nearest_m = std::numeric_limits<double>::infinity();
  std::uint64_t wall = 0;
  Eigen::Index axis = 0;
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (std::abs(direction[i]) < 1e-12) continue;
    const auto at = static_cast<std::size_t>(i);
    const double distance_m = ((direction[i] > 0.0 ? high[at] : low[at]) - from[i]) / direction[i];
    if (distance_m >= nearest_m) continue;
    nearest_m = distance_m;
    axis = i;
    wall = static_cast<std::uint64_t>(2 * i + (direction[i] > 0.0 ? 1 : 0));
  }
  const Eigen::Vector3d hit = from + nearest_m * direction;
  const double a = hit[(axis + 1) % 3];
  const double b = hit[(axis + 2) % 3];
  std::array<std::uint8_t, 3> colour{};
  for (std::uint64_t band = 0; band < 3; ++band) {
    const std::uint64_t seed = room.seed * 64 + wall * 4;
    const double value = 0.35 * detail::blotches(seed + band, a * 1.3, b * 1.3) +
                         0.35 * detail::blotches(seed + 3, a * 3.1, b * 3.1) +
                         0.30 * detail::blotches(seed + 1000003, a * 7.3, b * 7.3);
    colour[band] = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(1.6 * value - 0.3, 0.0, 1.0)));
  }
  return colour;
}

inline Eigen::Vector3d in_world(const Pose2& world_from_robot, const Eigen::Vector3d& bearing) {
  const double c = std::cos(world_from_robot.theta_rad);
  const double s = std::sin(world_from_robot.theta_rad);
  return {c * bearing.x() - s * bearing.y(), s * bearing.x() + c * bearing.y(), bearing.z()};
}

/// The panorama of a robot in the room.
inline camera::Panorama painted_panorama(const PaintedRoom& room, const Pose2& world_from_robot,
                                         const camera::PanoramaGeometry& geometry = {}) {
  camera::Panorama panorama;
  panorama.geometry = geometry;
  panorama.rgb = Image(geometry.width_px, geometry.height_px(), 3);
  panorama.valid.assign(panorama.rgb.data.size() / 3, 1);
  for (int v = 0; v < panorama.rgb.height_px; ++v) {
    for (int u = 0; u < panorama.rgb.width_px; ++u) {
      const auto colour = painted(room, world_from_robot.x_m, world_from_robot.y_m,
                                  in_world(world_from_robot, geometry.bearing({u, v})));
      std::copy(colour.begin(), colour.end(), panorama.rgb.at(u, v));
    }
  }
  return panorama;
}

/// The picture that a camera on the robot takes in the room; black where the camera does not see the world.
inline Image painted_picture(const PaintedRoom& room, const Pose2& world_from_robot, const camera::Camera& camera) {
  Image picture(camera.config().width_px, camera.config().height_px, 3);
  for (int v = 0; v < picture.height_px; ++v) {
    for (int u = 0; u < picture.width_px; ++u) {
      const auto bearing = camera.bearing({u, v});
      if (!bearing) continue;
      const auto colour =
          painted(room, world_from_robot.x_m, world_from_robot.y_m, in_world(world_from_robot, *bearing));
      std::copy(colour.begin(), colour.end(), picture.at(u, v));
    }
  }
  return picture;
}

}  // namespace homeward::testing
