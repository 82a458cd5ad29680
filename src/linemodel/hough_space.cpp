// SPDX-License-Identifier: Apache-2.0
#include "linemodel/hough_space.hpp"

#include <cmath>

#include "core/angles.hpp"
#include "linemodel/sight_map.hpp"

namespace homeward::linemodel {
namespace {

constexpr float kPiF = static_cast<float>(kPi);

/// The same line with its angle in [0, pi).
HoughPoint in_half(float angle_rad, float offset) {
  if (angle_rad < 0.0F) {
    angle_rad += kPiF;
    offset = -offset;
  }
  if (angle_rad >= kPiF) {
    angle_rad -= kPiF;
    offset = -offset;
  }
  return {angle_rad, offset};
}

}  // namespace

HoughSpace::HoughSpace(const camera::CameraConfig& camera) {
  const auto* pinhole = std::get_if<camera::Pinhole>(&camera.model);
  if (pinhole == nullptr) {
    most_offset_ = 0.5F * kPiF;
    return;
  }
  camera_from_robot_ = camera.robot_from_camera_rotation.toRotationMatrix().transpose().cast<float>();
  focal_px_ = static_cast<float>(0.5 * (pinhole->intrinsics.fx_px + pinhole->intrinsics.fy_px));
  const double across_px = std::max(pinhole->intrinsics.cx_px, camera.width_px - pinhole->intrinsics.cx_px);
  const double down_px = std::max(pinhole->intrinsics.cy_px, camera.height_px - pinhole->intrinsics.cy_px);
  most_offset_ = static_cast<float>(std::hypot(across_px, down_px));
}

std::optional<HoughPoint> HoughSpace::point(const Eigen::Vector3f& normal) const {
  if (!of_pinhole()) {
    const float level = std::sqrt(normal.x() * normal.x() + normal.y() * normal.y());
    return in_half(rough_atan2(normal.y(), normal.x()), rough_atan2(normal.z(), level));
  }
  // n . (x, y, f) = 0 along the line in the picture, so that its own normal is (nx, ny) and rho is -f nz / |(nx, ny)|.
  const Eigen::Vector3f in_camera = camera_from_robot_ * normal;
  const float level = std::hypot(in_camera.x(), in_camera.y());
  const float offset = -focal_px_ * in_camera.z() / level;
  if (!(std::abs(offset) <= most_offset_)) return std::nullopt;
  return in_half(std::atan2(in_camera.y(), in_camera.x()), offset);
}

float HoughSpace::offset_of_angle(double angle_rad) const {
  return of_pinhole() ? static_cast<float>(focal_px_ * std::tan(angle_rad)) : static_cast<float>(angle_rad);
}

}  // namespace homeward::linemodel
