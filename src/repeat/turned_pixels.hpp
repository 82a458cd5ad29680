// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "camera/camera.hpp"

namespace homeward::repeat {

/// Where the pixels of a picture are after a turn that shifts its middle. What is turned out of the picture stays in
/// it, and is not found there. Keeps a reference to the camera.
class TurnedPixels {
 public:
  TurnedPixels(const camera::Camera& camera, const Eigen::Vector2d& shift_px);
  [[nodiscard]] Eigen::Vector2d operator()(const Eigen::Vector2d& pixel_px) const;
  /// Rotation of bearings, from before the turn to after it. Nothing where there is none or the camera does not see
  /// the places that tell it.
  [[nodiscard]] const std::optional<Eigen::Quaterniond>& after_from_before() const { return turn_; }

 private:
  const camera::Camera& camera_;
  Eigen::Vector2d shift_px_;
  std::optional<Eigen::Quaterniond> turn_;
};

}  // namespace homeward::repeat
