// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "camera/camera_config.hpp"

namespace homeward::linemodel {

/// A straight edge as one point; where it begins and ends is left aside. (angle, offset) and (angle + pi, -offset) are
/// the same line; `angle_rad` is in [0, pi).
struct HoughPoint {
  float angle_rad = 0.0F;
  float offset = 0.0F;
};

/// The space that lines in pictures and lines of a plan are compared in (Fichtner & Grossmann 2003). Of a pinhole it is
/// that of (rho, phi) in the picture without distortion, from its principal point: the offset is in pixels. Of every
/// other camera, in whose pictures straight edges are curves, a line is the normal of the plane through it and the
/// camera's centre: its azimuth and, as the offset, its elevation in radians (ours). All directions are in the robot's
/// frame.
class HoughSpace {
 public:
  explicit HoughSpace(const camera::CameraConfig& camera);

  /// The point of a line whose plane has this normal, of any length; nothing where the space has none (a line that a
  /// pinhole never sees).
  [[nodiscard]] std::optional<HoughPoint> point(const Eigen::Vector3f& normal) const;
  /// The largest offset there is.
  [[nodiscard]] float most_offset() const { return most_offset_; }
  /// What an angle seen from the camera is as an offset: pixels or radians.
  [[nodiscard]] float offset_of_angle(double angle_rad) const;
  [[nodiscard]] bool of_pinhole() const { return focal_px_ > 0.0F; }

 private:
  Eigen::Matrix3f camera_from_robot_ = Eigen::Matrix3f::Identity();
  float focal_px_ = 0.0F;  // 0: normals
  float most_offset_ = 0.0F;
};

}  // namespace homeward::linemodel
