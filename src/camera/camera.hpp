// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "camera/camera_config.hpp"
#include "core/image.hpp"
#include "core/result.hpp"

namespace homeward::camera {

/// All problems of a camera description, empty when it is valid.
std::vector<std::string> problems(const CameraConfig& config);

/// Pixels to bearings and back for one camera. Bearings are unit vectors in the robot frame (x forward, y left, z up).
class Camera {
 public:
  virtual ~Camera() = default;

  /// Errors: kInvalidInput with all `problems` of the description.
  static Result<std::shared_ptr<const Camera>> create(const CameraConfig& config);

  [[nodiscard]] virtual const CameraConfig& config() const = 0;

  /// The bearing seen at a pixel, or nothing where the camera does not see the world (rim, own body, outside).
  [[nodiscard]] virtual std::optional<Eigen::Vector3d> bearing(const Eigen::Vector2d& pixel_px) const = 0;

  /// The pixel that sees a bearing, or nothing where none does.
  [[nodiscard]] virtual std::optional<Eigen::Vector2d> pixel(const Eigen::Vector3d& bearing_in_robot) const = 0;
};

/// Bearings of all pixels of a camera, computed once. Row v * width + u.
struct BearingTable {
  Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> bearings;  // HW x 3, robot frame; zero where not valid
  std::vector<std::uint8_t> valid;                                    // HW, 1 = sees the world
};
BearingTable bearing_table(const Camera& camera);

}  // namespace homeward::camera
