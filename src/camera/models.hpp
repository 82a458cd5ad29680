// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "camera/camera_config.hpp"

namespace homeward::camera {

// One pair of functions for each model: camera-frame directions from pixels and back. Camera frame: x right in the
// picture, y down, z along the optical axis. Directions given are of unit length; directions taken may have any.

/// Svoboda & Pajdla's central catadioptric camera; Goedemé 2007, eq. 15, 16, 19, 20 (16 without its 0/0, 20 without the
/// choice of the largest root, which fails below -50 degrees).
std::optional<Eigen::Vector3d> direction_from_pixel(const HyperbolicMirror& mirror, const Eigen::Vector2d& pixel_px);
std::optional<Eigen::Vector2d> pixel_from_direction(const HyperbolicMirror& mirror, const Eigen::Vector3d& direction);

std::optional<Eigen::Vector3d> direction_from_pixel(const Equirectangular& sphere, const Eigen::Vector2d& pixel_px,
                                                    int width_px, int height_px);
std::optional<Eigen::Vector2d> pixel_from_direction(const Equirectangular& sphere, const Eigen::Vector3d& direction,
                                                    int width_px, int height_px);

/// Brown (1966): radial k1 k2 k3 and tangential p1 p2. Undistorting is Newton's method to 1e-12; a pixel outside the
/// range where the distortion is one-to-one sees nothing.
std::optional<Eigen::Vector3d> direction_from_pixel(const Pinhole& pinhole, const Eigen::Vector2d& pixel_px);
std::optional<Eigen::Vector2d> pixel_from_direction(const Pinhole& pinhole, const Eigen::Vector3d& direction);

/// Kannala & Brandt (2006), eq. 6. The angle is Newton's to 1e-12; beyond the range where the radius grows with the
/// angle, and beyond the valid ring, nothing is seen.
std::optional<Eigen::Vector3d> direction_from_pixel(const Fisheye& fisheye, const Eigen::Vector2d& pixel_px);
std::optional<Eigen::Vector2d> pixel_from_direction(const Fisheye& fisheye, const Eigen::Vector3d& direction);

/// Mei & Rives (2007), eq. 1-4. With xi > 1 only directions in front of the sphere's contour are seen.
std::optional<Eigen::Vector3d> direction_from_pixel(const Mei& mei, const Eigen::Vector2d& pixel_px);
std::optional<Eigen::Vector2d> pixel_from_direction(const Mei& mei, const Eigen::Vector3d& direction);

}  // namespace homeward::camera
