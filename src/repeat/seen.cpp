// SPDX-License-Identifier: Apache-2.0
#include "repeat/seen.hpp"

namespace homeward::repeat {

std::optional<geometry::SeenPoint> seen_at(const camera::Camera& camera, const Eigen::Vector2d& pixel_px) {
  constexpr double kStep_px = 0.5;
  const auto bearing = camera.bearing(pixel_px);
  if (!bearing) return std::nullopt;
  geometry::SeenPoint seen;
  seen.bearing = *bearing;
  for (Eigen::Index i = 0; i < 2; ++i) {
    const Eigen::Vector2d step_px = kStep_px * Eigen::Vector2d::Unit(i);
    const auto before = camera.bearing(pixel_px - step_px);
    const auto after = camera.bearing(pixel_px + step_px);
    if (!before || !after) return std::nullopt;
    seen.bearing_per_px.col(i) = (*after - *before) / (2.0 * kStep_px);
  }
  return seen;
}

}  // namespace homeward::repeat
