// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/outline.hpp"
#include "core/pose2.hpp"
#include "sim/scene.hpp"

namespace homeward::sim {

/// A thing that stands on the floor where nobody expects it, upright: a box as large as a chair that somebody left
/// there, or another robot, which covers of the floor exactly what it touches.
struct Box {
  Pose2 pose;
  Outline foot{0.0, 0.25, 0.25, 0.25};
  double height_m = 0.9;
};

/// Where a ray meets a box first: distance along it and the colour there (sRGB 0..1 albedo).
struct BoxHit {
  float distance_m = 0.0F;
  Eigen::Array3f albedo = Eigen::Array3f::Zero();
};
std::optional<BoxHit> hit_box(const Box& box, const Eigen::Vector3f& origin_m, const Eigen::Vector3f& direction);

}  // namespace homeward::sim
