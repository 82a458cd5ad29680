// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "camera/camera.hpp"
#include "core/image.hpp"
#include "support/painted_room.hpp"
#include "support/sample_cameras.hpp"

namespace homeward::testing {

/// A camera of 70 degrees that looks ahead, with few pixels.
inline camera::CameraConfig small_lens_camera() {
  camera::CameraConfig config;
  config.width_px = 240;
  config.height_px = 180;
  config.model = camera::Pinhole{{171.4, 171.4, 119.5, 89.5}, {}};
  config.robot_from_camera_rotation = looking_forward();
  return config;
}

/// The grey picture of a lens in a painted room.
inline Image lens_picture(const PaintedRoom& room, const Pose2& world_from_robot, const camera::Camera& camera) {
  Image picture(camera.config().width_px, camera.config().height_px, 1);
  for (int v = 0; v < picture.height_px; ++v) {
    for (int u = 0; u < picture.width_px; ++u) {
      const auto bearing = camera.bearing({static_cast<double>(u), static_cast<double>(v)});
      if (!bearing) continue;
      const Eigen::Vector3d direction = in_world(world_from_robot, *bearing);
      *picture.at(u, v) = painted(room, world_from_robot.x_m, world_from_robot.y_m, direction)[1];
    }
  }
  return picture;
}

}  // namespace homeward::testing
