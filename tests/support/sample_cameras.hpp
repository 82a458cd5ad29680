// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "camera/camera_config.hpp"

namespace homeward::testing {

/// The usual mirror camera: looks up, forward at the top of its picture, left at the right.
inline camera::CameraConfig mirror_camera(double valid_radius_min_px = 30.0) {
  camera::CameraConfig config;
  config.width_px = 640;
  config.height_px = 480;
  config.model =
      camera::HyperbolicMirror{{598.4579, 598.4579, 319.5, 239.5}, 28.095, 23.4125, valid_radius_min_px, 231};
  config.robot_from_camera_translation_m = {0.0, 0.0, 1.2};
  config.robot_from_camera_rotation = Eigen::Quaterniond(std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5));
  return config;
}

/// The same with a quarter of the pixels.
inline camera::CameraConfig small_mirror_camera() {
  camera::CameraConfig config = mirror_camera();
  config.width_px = 320;
  config.height_px = 240;
  config.model = camera::HyperbolicMirror{{299.22895, 299.22895, 159.5, 119.5}, 28.095, 23.4125, 21.5, 115.5};
  return config;
}

/// Camera axes of a camera that looks forward: x right, y down, z forward.
inline Eigen::Quaterniond looking_forward() { return {0.5, -0.5, 0.5, -0.5}; }

inline camera::CameraConfig sphere_camera(int width_px = 512) {
  camera::CameraConfig config;
  config.width_px = width_px;
  config.height_px = width_px / 2;
  config.model = camera::Equirectangular{};
  config.robot_from_camera_rotation = looking_forward();
  return config;
}

inline camera::CameraConfig pinhole_camera() {
  camera::CameraConfig config;
  config.width_px = 640;
  config.height_px = 480;
  config.model = camera::Pinhole{{457.0, 455.0, 319.5, 239.5}, {-0.12, 0.03, 0.001, -0.0007, 0.002}};
  config.robot_from_camera_rotation = looking_forward();
  return config;
}

/// A lens of 185 degrees that looks up, its picture a circle.
inline camera::CameraConfig fisheye_camera() {
  camera::CameraConfig config;
  config.width_px = 640;
  config.height_px = 480;
  config.model = camera::Fisheye{{148.0, 147.5, 321.0, 238.0}, {0.02, -0.004, 0.001, -0.0002}, {0.0, 236.0}};
  config.robot_from_camera_rotation = Eigen::Quaterniond(std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5));
  return config;
}

/// A mirror camera by the unified model; with `xi` 1 its mirror is a parabola.
inline camera::CameraConfig mei_camera(double xi = 0.96) {
  camera::CameraConfig config;
  config.width_px = 640;
  config.height_px = 480;
  config.model = camera::Mei{{345.0, 344.0, 320.5, 241.0}, xi, {-0.08, 0.01, 0.0006, -0.0004}, {40.0, 236.0}};
  config.robot_from_camera_rotation = Eigen::Quaterniond(std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5));
  return config;
}

}  // namespace homeward::testing
