// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace homeward {

/// What a body covers of the floor, in its own frame (x forward, y left, from the point that it turns on): all within
/// `radius_m` of a box. A disc has a box of no size; a rectangle has no radius; both together are a rectangle with
/// rounded corners.
struct Outline {
  double radius_m = 0.35;
  double back_m = 0.0;   // of the box, from the turning point to the back,
  double front_m = 0.0;  // to the front,
  double side_m = 0.0;   // and to each side

  friend bool operator==(const Outline&, const Outline&) = default;
};

inline bool is_round(const Outline& outline) {
  return outline.back_m == 0.0 && outline.front_m == 0.0 && outline.side_m == 0.0;
}

/// From an outline to a point in the body's frame, metres; negative inside. Exact in closed form: outside the box to
/// its nearest edge or corner, inside to its nearest edge.
inline double distance_m(const Outline& outline, const Eigen::Vector2d& point_m) {
  const double middle_m = 0.5 * (outline.front_m - outline.back_m);
  const double beyond_x_m = std::abs(point_m.x() - middle_m) - 0.5 * (outline.front_m + outline.back_m);
  const double beyond_y_m = std::abs(point_m.y()) - outline.side_m;
  const double outside_m = Eigen::Vector2d(std::max(0.0, beyond_x_m), std::max(0.0, beyond_y_m)).norm();
  return outside_m + std::min(0.0, std::max(beyond_x_m, beyond_y_m)) - outline.radius_m;
}

/// Of the circle about the turning point that holds the whole body: what it sweeps when it turns in place.
inline double swept_radius_m(const Outline& outline) {
  return std::hypot(std::max(outline.front_m, outline.back_m), outline.side_m) + outline.radius_m;
}

}  // namespace homeward
