// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/pose2.hpp"
#include "sim/scene.hpp"

namespace homeward::sim {

/// A thing as large as a chair that somebody left standing on the floor: an upright box around `pose`.
struct Box {
  Pose2 pose;
  double side_m = 0.5;  // of its square foot
  double height_m = 0.9;
};

/// Where a ray meets a box first: distance along it and the colour there (sRGB 0..1 albedo).
struct BoxHit {
  float distance_m = 0.0F;
  Eigen::Array3f albedo = Eigen::Array3f::Zero();
};
std::optional<BoxHit> hit_box(const Box& box, const Eigen::Vector3f& origin_m, const Eigen::Vector3f& direction);

}  // namespace homeward::sim
