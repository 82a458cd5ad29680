// SPDX-License-Identifier: Apache-2.0
#include "camera/camera.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "camera/models.hpp"

namespace homeward::camera {
namespace {

constexpr int kMaxSidePx = 16384;

void check_intrinsics(const Intrinsics& k, std::vector<std::string>& problems, bool may_be_flipped = false) {
  const bool positive = k.fx_px > 0.0 && (k.fy_px > 0.0 || (may_be_flipped && k.fy_px < 0.0));
  if (!(positive && std::isfinite(k.fx_px) && std::isfinite(k.fy_px))) {
    problems.emplace_back(may_be_flipped ? "The focal length fx_px must be positive, and fy_px must not be 0."
                                         : "The focal lengths fx_px and fy_px must be positive.");
  }
  if (!std::isfinite(k.cx_px) || !std::isfinite(k.cy_px)) {
    problems.emplace_back("The principal point cx_px, cy_px must be finite.");
  }
}

void check_distortion(std::span<const double> coefficients, std::vector<std::string>& problems) {
  if (!std::ranges::all_of(coefficients, [](double coefficient) { return std::isfinite(coefficient); })) {
    problems.emplace_back("The distortion coefficients must be finite.");
  }
}

void check_ring(const ValidRing& ring, std::vector<std::string>& problems) {
  if (!(ring.radius_min_px >= 0.0 && ring.radius_max_px > ring.radius_min_px)) {
    problems.emplace_back("valid_radius_px must be [inner, outer] with 0 <= inner < outer.");
  }
}

struct ModelProblems {
  std::vector<std::string>& problems;
  void operator()(const HyperbolicMirror& mirror) const {
    check_intrinsics(mirror.intrinsics, problems);
    if (!(mirror.a_mm > 0.0 && mirror.b_mm > 0.0 && std::isfinite(mirror.a_mm) && std::isfinite(mirror.b_mm))) {
      problems.emplace_back("The mirror's a_mm and b_mm must be positive.");
    }
    check_ring({mirror.valid_radius_min_px, mirror.valid_radius_max_px}, problems);
    if (!std::isfinite(mirror.valid_radius_max_px)) problems.emplace_back("valid_radius_px must be finite.");
  }
  void operator()(const Equirectangular& /*sphere*/) const {}
  void operator()(const Pinhole& pinhole) const {
    check_intrinsics(pinhole.intrinsics, problems);
    check_distortion(pinhole.distortion, problems);
  }
  void operator()(const Fisheye& fisheye) const {
    check_intrinsics(fisheye.intrinsics, problems);
    check_distortion(fisheye.distortion, problems);
    check_ring(fisheye.valid, problems);
  }
  void operator()(const Mei& mei) const {
    check_intrinsics(mei.intrinsics, problems, true);
    constexpr double kLargestXi = 10.0;
    if (!(mei.xi >= 0.0 && mei.xi <= kLargestXi)) problems.emplace_back("xi must be between 0 and 10.");
    check_distortion(mei.distortion, problems);
    check_ring(mei.valid, problems);
  }
};

class ModelCamera final : public Camera {
 public:
  explicit ModelCamera(CameraConfig config)
      : config_(std::move(config)),
        robot_from_camera_(config_.robot_from_camera_rotation.normalized().toRotationMatrix()) {}

  [[nodiscard]] const CameraConfig& config() const override { return config_; }

  [[nodiscard]] std::optional<Eigen::Vector3d> bearing(const Eigen::Vector2d& pixel_px) const override {
    if (pixel_px.x() < -0.5 || pixel_px.y() < -0.5 || pixel_px.x() > config_.width_px - 0.5 ||
        pixel_px.y() > config_.height_px - 0.5) {
      return std::nullopt;
    }
    const auto direction = std::visit(
        [&](const auto& model) {
          if constexpr (std::is_same_v<std::decay_t<decltype(model)>, Equirectangular>) {
            return direction_from_pixel(model, pixel_px, config_.width_px, config_.height_px);
          } else {
            return direction_from_pixel(model, pixel_px);
          }
        },
        config_.model);
    if (!direction) return std::nullopt;
    return robot_from_camera_ * *direction;
  }

  [[nodiscard]] std::optional<Eigen::Vector2d> pixel(const Eigen::Vector3d& bearing_in_robot) const override {
    const Eigen::Vector3d direction = robot_from_camera_.transpose() * bearing_in_robot;
    const auto pixel_px = std::visit(
        [&](const auto& model) {
          if constexpr (std::is_same_v<std::decay_t<decltype(model)>, Equirectangular>) {
            return pixel_from_direction(model, direction, config_.width_px, config_.height_px);
          } else {
            return pixel_from_direction(model, direction);
          }
        },
        config_.model);
    if (!pixel_px || pixel_px->x() < -0.5 || pixel_px->y() < -0.5 || pixel_px->x() > config_.width_px - 0.5 ||
        pixel_px->y() > config_.height_px - 0.5) {
      return std::nullopt;
    }
    return pixel_px;
  }

 private:
  CameraConfig config_;
  Eigen::Matrix3d robot_from_camera_;
};

}  // namespace

std::vector<std::string> problems(const CameraConfig& config) {
  std::vector<std::string> found;
  if (config.width_px < 1 || config.height_px < 1 || config.width_px > kMaxSidePx || config.height_px > kMaxSidePx) {
    found.push_back("width_px and height_px must be between 1 and " + std::to_string(kMaxSidePx) + ".");
  }
  std::visit(ModelProblems{found}, config.model);
  if (!config.robot_from_camera_translation_m.allFinite()) found.emplace_back("translation_m must be finite.");
  const double length = config.robot_from_camera_rotation.norm();
  constexpr double kUnitTolerance = 1e-3;
  if (!(std::abs(length - 1.0) <= kUnitTolerance)) {
    found.emplace_back("rotation_wxyz must be a quaternion of unit length.");
  }
  return found;
}

Result<std::shared_ptr<const Camera>> Camera::create(const CameraConfig& config) {
  std::string message;
  for (const std::string& problem : problems(config)) message += (message.empty() ? "" : " ") + problem;
  if (!message.empty()) return fail(ErrorCode::kInvalidInput, message, "camera");
  return std::make_shared<const ModelCamera>(config);
}

BearingTable bearing_table(const Camera& camera) {
  const int width_px = camera.config().width_px;
  const int height_px = camera.config().height_px;
  BearingTable table;
  const auto pixels = static_cast<Eigen::Index>(width_px) * height_px;
  table.bearings.setZero(pixels, 3);
  table.valid.assign(static_cast<std::size_t>(pixels), 0);
  for (int v = 0; v < height_px; ++v) {
    for (int u = 0; u < width_px; ++u) {
      const auto bearing = camera.bearing({u, v});
      if (!bearing) continue;
      const Eigen::Index row = static_cast<Eigen::Index>(v) * width_px + u;
      table.bearings.row(row) = bearing->cast<float>();
      table.valid[static_cast<std::size_t>(row)] = 1;
    }
  }
  return table;
}

}  // namespace homeward::camera
