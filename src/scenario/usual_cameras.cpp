// SPDX-License-Identifier: Apache-2.0
#include "scenario/usual_cameras.hpp"

#include <cmath>
#include <numbers>

namespace homeward::scenario {

std::optional<camera::CameraConfig> usual_camera(const std::string& model) {
  camera::CameraConfig config;
  config.robot_from_camera_translation_m = {0.0, 0.0, 1.2};
  // Forward-looking: x right, y down, z ahead.
  config.robot_from_camera_rotation = Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5);
  if (model == "hyperbolic_mirror") {
    // The mirror of the papers' robots: looks up, forward at the top of the picture.
    config.width_px = 640;
    config.height_px = 480;
    config.model = camera::HyperbolicMirror{{598.4579, 598.4579, 319.5, 239.5}, 28.095, 23.4125, 43.05, 231.0};
    const double half = std::sqrt(0.5);
    config.robot_from_camera_rotation = Eigen::Quaterniond(half, 0.0, 0.0, half);
    return config;
  }
  if (model == "equirectangular") {
    config.width_px = 1024;
    config.height_px = 512;
    config.model = camera::Equirectangular{};
    return config;
  }
  if (model == "pinhole") {
    config.width_px = 640;
    config.height_px = 480;
    config.model = camera::Pinhole{{457.0, 457.0, 319.5, 239.5}, {}};
    return config;
  }
  if (model == "pinhole_320") {  // the same in half the size
    config.width_px = 320;
    config.height_px = 240;
    config.model = camera::Pinhole{{228.5, 228.5, 159.5, 119.5}, {}};
    return config;
  }
  return std::nullopt;
}

}  // namespace homeward::scenario
