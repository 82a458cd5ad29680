// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>

#include "camera/camera.hpp"
#include "core/image.hpp"
#include "core/pose2.hpp"
#include "linemodel/feature_edges.hpp"
#include "linemodel/plan.hpp"
#include "raycast/ray_scene.hpp"
#include "support/mesh_of_boxes.hpp"

namespace homeward::linemodel {

/// Two rooms of 6 m by 4 m side by side with a doorway between them, things in both, no two walls alike. The first is
/// x 0 to 6, the second x 6.2 to 12.2.
inline Plan two_rooms() {
  MeshOfBoxes mesh;
  mesh.box({-0.2F, -0.2F, -0.1F}, {12.4F, 4.2F, 0.0F});  // floor
  mesh.box({-0.2F, -0.2F, 0.0F}, {12.4F, 0.0F, 2.6F});
  mesh.box({-0.2F, 4.0F, 0.0F}, {12.4F, 4.2F, 2.6F});
  mesh.box({-0.2F, 0.0F, 0.0F}, {0.0F, 4.0F, 2.6F});
  mesh.box({12.2F, 0.0F, 0.0F}, {12.4F, 4.0F, 2.6F});
  mesh.box({6.0F, 0.0F, 0.0F}, {6.2F, 2.6F, 2.6F});
  mesh.box({6.0F, 3.6F, 0.0F}, {6.2F, 4.0F, 2.6F});
  mesh.box({0.0F, 0.0F, 0.0F}, {0.6F, 1.5F, 2.0F});  // a wardrobe
  mesh.box({3.0F, 0.0F, 0.0F}, {4.8F, 0.7F, 0.8F});  // a table
  mesh.box({1.5F, 3.6F, 0.9F}, {2.7F, 4.0F, 1.5F});  // a shelf
  mesh.box({9.0F, 0.0F, 0.0F}, {9.5F, 0.5F, 1.9F});
  mesh.box({10.5F, 2.5F, 0.0F}, {12.2F, 4.0F, 0.5F});  // a bed
  return plan_of_mesh(mesh.vertices_m(), mesh.triangles());
}

/// Four rooms in a row, x 0 to 4, 4.2 to 9.2, 9.4 to 14.4 and 14.6 to 18.6. A half turn about (9.3, 2) makes the same
/// of the two in the middle, of all walls and doorways; of the outer ones the first is furnished, out of sight from the
/// middle, and the last is bare.
inline Plan twin_rooms() {
  MeshOfBoxes mesh;
  const auto twin_boxes = [&](const Eigen::Vector3f& least, const Eigen::Vector3f& most) {
    mesh.box(least, most);
    mesh.box({18.6F - most.x(), 4.0F - most.y(), least.z()}, {18.6F - least.x(), 4.0F - least.y(), most.z()});
  };
  mesh.box({-0.2F, -0.2F, -0.1F}, {18.8F, 4.2F, 0.0F});  // floor
  twin_boxes({-0.2F, -0.2F, 0.0F}, {18.8F, 0.0F, 2.6F});
  twin_boxes({-0.2F, 0.0F, 0.0F}, {0.0F, 4.0F, 2.6F});
  twin_boxes({4.0F, 0.0F, 0.0F}, {4.2F, 0.6F, 2.6F});
  twin_boxes({4.0F, 1.6F, 0.0F}, {4.2F, 4.0F, 2.6F});
  twin_boxes({9.2F, 0.0F, 0.0F}, {9.4F, 1.5F, 2.6F});
  twin_boxes({4.2F, 3.3F, 0.0F}, {5.4F, 4.0F, 2.0F});  // wardrobes
  twin_boxes({6.5F, 0.0F, 0.0F}, {8.3F, 0.7F, 0.8F});  // tables
  twin_boxes({7.0F, 3.7F, 0.9F}, {8.2F, 4.0F, 1.5F});  // shelves
  mesh.box({3.3F, 2.0F, 0.0F}, {4.0F, 3.0F, 2.6F});    // a closet
  mesh.box({1.5F, 2.8F, 0.0F}, {1.7F, 4.0F, 2.6F});    // a wall
  mesh.box({2.2F, 3.3F, 0.0F}, {3.9F, 4.0F, 0.9F});
  mesh.box({2.0F, 0.0F, 0.0F}, {3.6F, 0.3F, 1.5F});
  return plan_of_mesh(mesh.vertices_m(), mesh.triangles());
}

/// What a camera sees of a plan, each face in a grey of its own.
inline Image shaded_picture(const Plan& plan, const raycast::RayScene& rays, const camera::Camera& camera,
                            const Pose2& robot) {
  const camera::CameraConfig& config = camera.config();
  Image picture(config.width_px, config.height_px, 3);
  const Eigen::Vector3d t = config.robot_from_camera_translation_m;
  const Pose2 eye = robot * Pose2{t.x(), t.y(), 0.0};
  const Eigen::Vector3f origin_m(static_cast<float>(eye.x_m), static_cast<float>(eye.y_m), static_cast<float>(t.z()));
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(robot.theta_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  for (int v = 0; v < config.height_px; ++v) {
    for (int u = 0; u < config.width_px; ++u) {
      const auto bearing = camera.bearing(Eigen::Vector2d(u, v));
      double grey = 0.0;
      const auto hit = bearing ? rays.first_hit(origin_m, (turn * *bearing).cast<float>(), 50.0F) : std::nullopt;
      if (hit) {
        const Eigen::Vector3f a = plan.vertices_m.row(plan.triangles(hit->triangle, 0));
        const Eigen::Vector3f b = plan.vertices_m.row(plan.triangles(hit->triangle, 1));
        const Eigen::Vector3f c = plan.vertices_m.row(plan.triangles(hit->triangle, 2));
        const Eigen::Vector3f normal = (b - a).cross(c - a).normalized().cwiseAbs();
        grey = 70.0 * normal.x() + 140.0 * normal.y() + 200.0 * normal.z() + 30.0 * std::abs(std::sin(7.0 * a.sum()));
      }
      std::uint8_t* pixel = picture.at(u, v);
      pixel[0] = pixel[1] = pixel[2] = static_cast<std::uint8_t>(grey);
    }
  }
  return picture;
}

/// Forward-looking, 70 degrees wide, 1 m over the floor.
inline camera::CameraConfig small_pinhole() {
  camera::CameraConfig config;
  config.width_px = 320;
  config.height_px = 240;
  config.model = camera::Pinhole{{228.5, 228.5, 159.5, 119.5}, {}};
  config.robot_from_camera_translation_m = {0.1, 0.0, 1.0};
  config.robot_from_camera_rotation = Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5);
  return config;
}

/// All around, 1.2 m over the floor.
inline camera::CameraConfig small_panorama() {
  camera::CameraConfig config;
  config.width_px = 720;
  config.height_px = 360;
  config.model = camera::Equirectangular{};
  config.robot_from_camera_rotation = Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5);
  config.robot_from_camera_translation_m = {0.0, 0.0, 1.2};
  return config;
}

}  // namespace homeward::linemodel
