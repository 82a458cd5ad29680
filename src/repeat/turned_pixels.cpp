// SPDX-License-Identifier: Apache-2.0
#include "repeat/turned_pixels.hpp"

namespace homeward::repeat {

TurnedPixels::TurnedPixels(const camera::Camera& camera, const Eigen::Vector2d& shift_px)
    : camera_(camera), shift_px_(shift_px) {
  if (shift_px.isZero()) return;
  const camera::CameraConfig& config = camera.config();
  const Eigen::Vector2d middle_px(0.5 * (config.width_px - 1), 0.5 * (config.height_px - 1));
  const auto before = camera.bearing(middle_px - 0.5 * shift_px);
  const auto after = camera.bearing(middle_px + 0.5 * shift_px);
  if (before && after) turn_ = Eigen::Quaterniond::FromTwoVectors(*before, *after);
}

Eigen::Vector2d TurnedPixels::operator()(const Eigen::Vector2d& pixel_px) const {
  if (!turn_) return pixel_px + shift_px_;
  const auto bearing = camera_.bearing(pixel_px);
  if (!bearing) return pixel_px + shift_px_;
  return camera_.pixel(*turn_ * *bearing).value_or(pixel_px + shift_px_);
}

}  // namespace homeward::repeat
