// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "camera/camera.hpp"
#include "geometry/seen_point.hpp"

namespace homeward::repeat {

/// A pixel of a camera for geometry on bearings; nothing where the camera does not see the world there and around.
std::optional<geometry::SeenPoint> seen_at(const camera::Camera& camera, const Eigen::Vector2d& pixel_px);

}  // namespace homeward::repeat
