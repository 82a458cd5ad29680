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

/// What of a ray lies in something convex, in multiples of its direction; from > to: nothing.
struct Reach {
  float from = -std::numeric_limits<float>::infinity();
  float to = std::numeric_limits<float>::infinity();
};
constexpr Reach kNothing{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};

/// Between two planes across one axis (the slabs of Kay & Kajiya 1986).
Reach in_slab(float from, float along, float least, float most) {
  if (std::abs(along) < 1e-9F) return from < least || from > most ? kNothing : Reach{};
  const float a = (least - from) / along;
  const float b = (most - from) / along;
  return {std::min(a, b), std::max(a, b)};
}

Reach both(const Reach& a, const Reach& b) { return {std::max(a.from, b.from), std::min(a.to, b.to)}; }

Reach in_circle(const Eigen::Vector2f& from, const Eigen::Vector2f& along, float radius_m) {
  const float a = along.squaredNorm();
  if (a < 1e-12F) return from.squaredNorm() > radius_m * radius_m ? kNothing : Reach{};
  const float b = from.dot(along);
  const float discriminant = b * b - a * (from.squaredNorm() - radius_m * radius_m);
  if (discriminant <= 0.0F) return kNothing;
  const float half = std::sqrt(discriminant);
  return {(-b - half) / a, (-b + half) / a};
}

/// In a rectangle with rounded corners, which is two rectangles and four circles, and convex.
Reach in_rounded(const Eigen::Vector2f& from, const Eigen::Vector2f& along, const Eigen::Vector2f& half_m,
                 float radius_m) {
  Reach all = kNothing;
  const auto take = [&](const Reach& part) {
    if (part.from > part.to) return;
    all = {std::min(all.from, part.from), std::max(all.to, part.to)};
  };
  for (const Eigen::Vector2f& most :
       {Eigen::Vector2f(half_m.x() + radius_m, half_m.y()), Eigen::Vector2f(half_m.x(), half_m.y() + radius_m)}) {
    take(both(in_slab(from.x(), along.x(), -most.x(), most.x()), in_slab(from.y(), along.y(), -most.y(), most.y())));
  }
  for (const float x : {-half_m.x(), half_m.x()}) {
    for (const float y : {-half_m.y(), half_m.y()}) take(in_circle(from - Eigen::Vector2f(x, y), along, radius_m));
  }
  return all;
}

}  // namespace

std::optional<BoxHit> hit_box(const Box& box, const Eigen::Vector3f& origin_m, const Eigen::Vector3f& direction) {
  // In the frame of the middle of its foot.
  const auto c = static_cast<float>(std::cos(box.pose.theta_rad));
  const auto s = static_cast<float>(std::sin(box.pose.theta_rad));
  const auto turned = [&](const Eigen::Vector3f& v) {
    return Eigen::Vector3f(c * v.x() + s * v.y(), -s * v.x() + c * v.y(), v.z());
  };
  const Eigen::Vector3f middle_m(static_cast<float>(0.5 * (box.foot.front_m - box.foot.back_m)), 0.0F, 0.0F);
  const Eigen::Vector3f from =
      turned(origin_m - Eigen::Vector3f(static_cast<float>(box.pose.x_m), static_cast<float>(box.pose.y_m), 0.0F)) -
      middle_m;
  const Eigen::Vector3f along = turned(direction);
  const Eigen::Vector2f half_m(static_cast<float>(0.5 * (box.foot.front_m + box.foot.back_m)),
                               static_cast<float>(box.foot.side_m));
  const auto radius_m = static_cast<float>(box.foot.radius_m);
  const Reach upright = in_slab(from.z(), along.z(), 0.0F, static_cast<float>(box.height_m));
  const Reach in_x = in_slab(from.x(), along.x(), -half_m.x(), half_m.x());
  const Reach in_y = in_slab(from.y(), along.y(), -half_m.y(), half_m.y());
  const Reach foot = radius_m > 0.0F ? in_rounded(from.head<2>(), along.head<2>(), half_m, radius_m) : both(in_x, in_y);
  const Reach inside = both(foot, upright);
  if (inside.from <= 0.0F || inside.from > inside.to) return std::nullopt;
  const Eigen::Vector3f at = from + inside.from * along;
  if (upright.from > foot.from) {
    return BoxHit{inside.from, cardboard(along.z() > 0.0F ? 4 : 5, at.x(), at.y())};
  }
  if (radius_m > 0.0F) {
    // Round about, as far as on a circle through the nearer sides.
    const float across_m = std::atan2(at.y(), at.x()) * (radius_m + half_m.minCoeff());
    return BoxHit{inside.from, cardboard(6, across_m, at.z())};
  }
  const bool in_front = in_x.from >= in_y.from;
  const int face = in_front ? (along.x() > 0.0F ? 0 : 1) : (along.y() > 0.0F ? 2 : 3);
  return BoxHit{inside.from, cardboard(face, in_front ? at.y() : at.x(), at.z())};
}

}  // namespace homeward::sim
