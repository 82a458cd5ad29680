// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <limits>
#include <variant>

namespace homeward::camera {

/// Focal lengths and principal point; pixel (0,0) is the centre of the first pixel.
struct Intrinsics {
  double fx_px = 0.0;
  double fy_px = 0.0;
  double cx_px = 0.0;
  double cy_px = 0.0;
};

/// A perspective camera looking into a hyperbolic mirror (Svoboda & Pajdla; Goedemé 2007, eq. 15, 16, 19, 20).
struct HyperbolicMirror {
  Intrinsics intrinsics;
  double a_mm = 0.0;  // (z+e)^2/a^2 - (x^2+y^2)/b^2 = 1, e = sqrt(a^2+b^2)
  double b_mm = 0.0;
  double valid_radius_min_px = 0.0;  // inside: the camera's own picture
  double valid_radius_max_px = 0.0;  // outside: the rim
};

/// Columns are azimuth, rows elevation, full sphere; z through the centre column at the horizon. No intrinsics.
struct Equirectangular {};

/// Perspective camera with Brown distortion, order k1 k2 p1 p2 k3.
struct Pinhole {
  Intrinsics intrinsics;
  std::array<double, 5> distortion{};
};

/// The part of a picture that shows the world: distances from the principal point.
struct ValidRing {
  double radius_min_px = 0.0;
  double radius_max_px = std::numeric_limits<double>::infinity();
};

/// Fisheye lens: radius in the picture f (t + k1 t^3 + k2 t^5 + k3 t^7 + k4 t^9) for an angle t off the axis (Kannala &
/// Brandt 2006, as OpenCV's fisheye module has it).
struct Fisheye {
  Intrinsics intrinsics;
  std::array<double, 4> distortion{};  // k1 k2 k3 k4
  ValidRing valid;
};

/// The unified model of mirrors and wide lenses: onto the unit sphere, from there by perspective out of a point xi
/// behind its centre, then Brown distortion (Mei & Rives 2007, as OpenCV's omnidir module has it, without skew).
/// A mirror shows what lies towards the camera in the middle of the picture, so z points out of the mirror at the
/// camera and the picture is turned over: fy_px is negative, x right in the picture, y up.
struct Mei {
  Intrinsics intrinsics;
  double xi = 1.0;
  std::array<double, 4> distortion{};  // k1 k2 p1 p2
  ValidRing valid;
};

using CameraModel = std::variant<HyperbolicMirror, Equirectangular, Pinhole, Fisheye, Mei>;

/// One camera as `camera.json` describes it. Camera frame: x right in the picture, y down, z along the optical axis.
struct CameraConfig {
  int width_px = 0;
  int height_px = 0;
  CameraModel model;
  Eigen::Vector3d robot_from_camera_translation_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond robot_from_camera_rotation = Eigen::Quaterniond::Identity();
  bool nominal = false;  // a guessed camera: good for recognition, not for geometry
};

}  // namespace homeward::camera
