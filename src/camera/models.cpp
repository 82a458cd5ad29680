// SPDX-License-Identifier: Apache-2.0
#include "camera/models.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "core/angles.hpp"

namespace homeward::camera {
namespace {

Eigen::Vector2d normalised(const Intrinsics& k, const Eigen::Vector2d& pixel_px) {
  return {(pixel_px.x() - k.cx_px) / k.fx_px, (pixel_px.y() - k.cy_px) / k.fy_px};
}

Eigen::Vector2d to_pixel(const Intrinsics& k, const Eigen::Vector2d& point) {
  return {k.fx_px * point.x() + k.cx_px, k.fy_px * point.y() + k.cy_px};
}

double eccentricity_mm(const HyperbolicMirror& mirror) { return std::hypot(mirror.a_mm, mirror.b_mm); }

bool inside_valid_ring(const HyperbolicMirror& mirror, const Eigen::Vector2d& pixel_px) {
  const double radius_px = (pixel_px - Eigen::Vector2d(mirror.intrinsics.cx_px, mirror.intrinsics.cy_px)).norm();
  return radius_px >= mirror.valid_radius_min_px && radius_px <= mirror.valid_radius_max_px;
}

struct Distorted {
  Eigen::Vector2d point;
  Eigen::Matrix2d jacobian;
};

Distorted distort(const Pinhole& pinhole, const Eigen::Vector2d& point) {
  const auto [k1, k2, p1, p2, k3] = pinhole.distortion;
  const double x = point.x();
  const double y = point.y();
  const double r2 = point.squaredNorm();
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double radial_slope = k1 + r2 * (2.0 * k2 + r2 * 3.0 * k3);  // d radial / d r2
  Distorted result;
  result.point = {x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
                  y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
  result.jacobian << radial + 2.0 * x * x * radial_slope + 2.0 * p1 * y + 6.0 * p2 * x,
      2.0 * x * y * radial_slope + 2.0 * p1 * x + 2.0 * p2 * y,
      2.0 * x * y * radial_slope + 2.0 * p1 * x + 2.0 * p2 * y,
      radial + 2.0 * y * y * radial_slope + 6.0 * p1 * y + 2.0 * p2 * x;
  return result;
}

}  // namespace

std::optional<Eigen::Vector3d> direction_from_pixel(const HyperbolicMirror& mirror, const Eigen::Vector2d& pixel_px) {
  if (!inside_valid_ring(mirror, pixel_px)) return std::nullopt;
  const double e_mm = eccentricity_mm(mirror);
  const Eigen::Vector3d ray = normalised(mirror.intrinsics, pixel_px).homogeneous();
  const double b2 = mirror.b_mm * mirror.b_mm;
  const double denominator = e_mm * ray.z() - mirror.a_mm * ray.norm();
  if (denominator <= 0.0) return std::nullopt;  // the ray misses this sheet of the hyperboloid
  const Eigen::Vector3d on_mirror = (b2 / denominator) * ray + Eigen::Vector3d(0.0, 0.0, -2.0 * e_mm);
  return on_mirror.normalized();
}

std::optional<Eigen::Vector2d> pixel_from_direction(const HyperbolicMirror& mirror, const Eigen::Vector3d& direction) {
  const double e_mm = eccentricity_mm(mirror);
  const double denominator = mirror.a_mm * direction.norm() - e_mm * direction.z();
  if (denominator <= 0.0) return std::nullopt;  // above the asymptotic cone: never meets the mirror
  const double lambda = mirror.b_mm * mirror.b_mm / denominator;
  const Eigen::Vector3d seen_from_camera = lambda * direction + Eigen::Vector3d(0.0, 0.0, 2.0 * e_mm);
  if (seen_from_camera.z() <= 0.0) return std::nullopt;
  const Eigen::Vector2d pixel_px = to_pixel(mirror.intrinsics, seen_from_camera.hnormalized());
  if (!inside_valid_ring(mirror, pixel_px)) return std::nullopt;
  return pixel_px;
}

std::optional<Eigen::Vector3d> direction_from_pixel(const Equirectangular& /*sphere*/, const Eigen::Vector2d& pixel_px,
                                                    int width_px, int height_px) {
  // Rows beyond the poles see nothing; columns wrap.
  if (pixel_px.y() < -0.5 || pixel_px.y() > height_px - 0.5) return std::nullopt;
  const double to_the_right_rad = 2.0 * kPi * ((pixel_px.x() + 0.5) / width_px - 0.5);
  const double down_rad = kPi * ((pixel_px.y() + 0.5) / height_px - 0.5);
  return Eigen::Vector3d(std::cos(down_rad) * std::sin(to_the_right_rad), std::sin(down_rad),
                         std::cos(down_rad) * std::cos(to_the_right_rad));
}

std::optional<Eigen::Vector2d> pixel_from_direction(const Equirectangular& /*sphere*/, const Eigen::Vector3d& direction,
                                                    int width_px, int height_px) {
  const double to_the_right_rad = std::atan2(direction.x(), direction.z());
  const double down_rad = std::atan2(direction.y(), std::hypot(direction.x(), direction.z()));
  double u_px = (to_the_right_rad / (2.0 * kPi) + 0.5) * width_px - 0.5;
  if (u_px >= width_px - 0.5) u_px -= width_px;
  return Eigen::Vector2d(u_px, (down_rad / kPi + 0.5) * height_px - 0.5);
}

std::optional<Eigen::Vector3d> direction_from_pixel(const Pinhole& pinhole, const Eigen::Vector2d& pixel_px) {
  const Eigen::Vector2d distorted = normalised(pinhole.intrinsics, pixel_px);
  Eigen::Vector2d point = distorted;
  constexpr int kMaxSteps = 50;
  constexpr double kConverged = 1e-12;
  for (int step = 0; step < kMaxSteps; ++step) {
    const Distorted now = distort(pinhole, point);
    if (now.jacobian.determinant() <= 0.0) return std::nullopt;  // folded over: no unique direction
    const Eigen::Vector2d error = now.point - distorted;
    if (error.norm() < kConverged) return point.homogeneous().normalized();
    point -= now.jacobian.inverse() * error;
  }
  return std::nullopt;
}

std::optional<Eigen::Vector2d> pixel_from_direction(const Pinhole& pinhole, const Eigen::Vector3d& direction) {
  if (direction.z() <= 0.0) return std::nullopt;
  const Distorted distorted = distort(pinhole, direction.hnormalized());
  if (distorted.jacobian.determinant() <= 0.0) return std::nullopt;
  return to_pixel(pinhole.intrinsics, distorted.point);
}

}  // namespace homeward::camera
