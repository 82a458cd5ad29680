// SPDX-License-Identifier: Apache-2.0
#include "sim/box.hpp"

#include <cmath>
#include <limits>

#include "sim/floor.hpp"

namespace homeward::sim {
namespace {

/// Printed cardboard: patches of a few browns, each face its own, with dark tape along the middle.
Eigen::Array3f cardboard(int face, float across_m, float up_m) {
  constexpr float kPatch_m = 0.045F;
  constexpr float kTape_m = 0.03F;
  if (std::abs(across_m) < kTape_m) return {0.25F, 0.2F, 0.15F};
  const auto column = static_cast<std::uint32_t>(static_cast<int>(std::floor(across_m / kPatch_m)) + 64);
  const auto row = static_cast<std::uint32_t>(static_cast<int>(std::floor(up_m / kPatch_m)) + 64);
  std::uint32_t bits = column * 73'856'093U ^ row * 19'349'663U ^ static_cast<std::uint32_t>(face) * 83'492'791U;
  bits = (bits ^ (bits >> 13U)) * 0x5BD1E995U;
  const float tone = 0.35F + 0.45F * static_cast<float>((bits >> 20U) & 15U) / 15.0F;
  return {tone, 0.8F * tone, 0.55F * tone};
}

}  // namespace

std::optional<BoxHit> hit_box(const Box& box, const Eigen::Vector3f& origin_m, const Eigen::Vector3f& direction) {
  // Slabs in the box's own frame (Kay & Kajiya 1986).
  const auto c = static_cast<float>(std::cos(box.pose.theta_rad));
  const auto s = static_cast<float>(std::sin(box.pose.theta_rad));
  const auto turned = [&](const Eigen::Vector3f& v) {
    return Eigen::Vector3f(c * v.x() + s * v.y(), -s * v.x() + c * v.y(), v.z());
  };
  const Eigen::Vector3f from =
      turned(origin_m - Eigen::Vector3f(static_cast<float>(box.pose.x_m), static_cast<float>(box.pose.y_m), 0.0F));
  const Eigen::Vector3f along = turned(direction);
  const auto half_m = static_cast<float>(0.5 * box.side_m);
  const Eigen::Vector3f least(-half_m, -half_m, 0.0F);
  const Eigen::Vector3f most(half_m, half_m, static_cast<float>(box.height_m));
  float enters_m = 0.0F;
  float leaves_m = std::numeric_limits<float>::infinity();
  int face = -1;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(along[axis]) < 1e-9F) {
      if (from[axis] < least[axis] || from[axis] > most[axis]) return std::nullopt;
      continue;
    }
    const float a = (least[axis] - from[axis]) / along[axis];
    const float b = (most[axis] - from[axis]) / along[axis];
    if (std::min(a, b) > enters_m) {
      enters_m = std::min(a, b);
      face = 2 * axis + (a < b ? 0 : 1);
    }
    leaves_m = std::min(leaves_m, std::max(a, b));
  }
  if (face < 0 || enters_m > leaves_m) return std::nullopt;
  const Eigen::Vector3f at = from + enters_m * along;
  const float across_m = face < 2 ? at.y() : at.x();
  return BoxHit{enters_m, cardboard(face, across_m, face < 4 ? at.z() : at.y())};
}

}  // namespace homeward::sim
