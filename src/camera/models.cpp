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

bool inside(const ValidRing& ring, const Intrinsics& k, const Eigen::Vector2d& pixel_px) {
  const double radius_px = (pixel_px - Eigen::Vector2d(k.cx_px, k.cy_px)).norm();
  return radius_px >= ring.radius_min_px && radius_px <= ring.radius_max_px;
}

bool inside_valid_ring(const HyperbolicMirror& mirror, const Eigen::Vector2d& pixel_px) {
  return inside({mirror.valid_radius_min_px, mirror.valid_radius_max_px}, mirror.intrinsics, pixel_px);
}

struct Distorted {
  Eigen::Vector2d point;
  Eigen::Matrix2d jacobian;
};

/// Brown's distortion: k1 k2 p1 p2 k3.
Distorted distort(const std::array<double, 5>& coefficients, const Eigen::Vector2d& point) {
  const auto [k1, k2, p1, p2, k3] = coefficients;
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

constexpr int kMaxSteps = 50;
constexpr double kConverged = 1e-12;

/// Newton's method; nothing where the distortion is not one-to-one.
std::optional<Eigen::Vector2d> undistort(const std::array<double, 5>& coefficients, const Eigen::Vector2d& distorted) {
  Eigen::Vector2d point = distorted;
  for (int step = 0; step < kMaxSteps; ++step) {
    const Distorted now = distort(coefficients, point);
    if (now.jacobian.determinant() <= 0.0) return std::nullopt;  // folded over: no unique direction
    const Eigen::Vector2d error = now.point - distorted;
    if (error.norm() < kConverged) return point;
    point -= now.jacobian.inverse() * error;
  }
  return std::nullopt;
}

std::array<double, 5> brown(const Mei& mei) {
  const auto [k1, k2, p1, p2] = mei.distortion;
  return {k1, k2, p1, p2, 0.0};
}

struct FisheyeRadius {
  double radius = 0.0;
  double slope = 0.0;
};

FisheyeRadius fisheye_radius(const Fisheye& fisheye, double angle_rad) {
  const auto [k1, k2, k3, k4] = fisheye.distortion;
  const double t2 = angle_rad * angle_rad;
  return {angle_rad * (1.0 + t2 * (k1 + t2 * (k2 + t2 * (k3 + t2 * k4)))),
          1.0 + t2 * (3.0 * k1 + t2 * (5.0 * k2 + t2 * (7.0 * k3 + t2 * 9.0 * k4)))};
}

/// The radius grows with the angle from the axis to here: beyond, two angles would share a pixel.
bool grows_up_to(const Fisheye& fisheye, double angle_rad) {
  constexpr int kSamples = 32;
  for (int i = 0; i <= kSamples; ++i) {
    if (fisheye_radius(fisheye, angle_rad * i / kSamples).slope <= 0.0) return false;
  }
  return true;
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
  const auto point = undistort(pinhole.distortion, normalised(pinhole.intrinsics, pixel_px));
  if (!point) return std::nullopt;
  return point->homogeneous().normalized();
}

std::optional<Eigen::Vector2d> pixel_from_direction(const Pinhole& pinhole, const Eigen::Vector3d& direction) {
  if (direction.z() <= 0.0) return std::nullopt;
  const Distorted distorted = distort(pinhole.distortion, direction.hnormalized());
  if (distorted.jacobian.determinant() <= 0.0) return std::nullopt;
  return to_pixel(pinhole.intrinsics, distorted.point);
}

std::optional<Eigen::Vector3d> direction_from_pixel(const Fisheye& fisheye, const Eigen::Vector2d& pixel_px) {
  if (!inside(fisheye.valid, fisheye.intrinsics, pixel_px)) return std::nullopt;
  const Eigen::Vector2d point = normalised(fisheye.intrinsics, pixel_px);
  const double radius = point.norm();
  if (radius < kConverged) return Eigen::Vector3d::UnitZ();
  double angle_rad = std::min(radius, kPi);
  for (int step = 0; step < kMaxSteps; ++step) {
    const FisheyeRadius now = fisheye_radius(fisheye, angle_rad);
    if (std::abs(now.radius - radius) < kConverged) break;
    if (now.slope <= 0.0) return std::nullopt;
    angle_rad -= (now.radius - radius) / now.slope;
  }
  if (!(angle_rad >= 0.0 && angle_rad <= kPi) ||
      std::abs(fisheye_radius(fisheye, angle_rad).radius - radius) > 10.0 * kConverged ||
      !grows_up_to(fisheye, angle_rad)) {
    return std::nullopt;
  }
  const Eigen::Vector2d across = std::sin(angle_rad) / radius * point;
  return Eigen::Vector3d(across.x(), across.y(), std::cos(angle_rad));
}

std::optional<Eigen::Vector2d> pixel_from_direction(const Fisheye& fisheye, const Eigen::Vector3d& direction) {
  const double across = std::hypot(direction.x(), direction.y());
  const double angle_rad = std::atan2(across, direction.z());
  if (!grows_up_to(fisheye, angle_rad)) return std::nullopt;
  Eigen::Vector2d point = Eigen::Vector2d::Zero();
  if (across > 0.0) point = fisheye_radius(fisheye, angle_rad).radius / across * direction.head<2>();
  const Eigen::Vector2d pixel_px = to_pixel(fisheye.intrinsics, point);
  if (!inside(fisheye.valid, fisheye.intrinsics, pixel_px)) return std::nullopt;
  return pixel_px;
}

std::optional<Eigen::Vector3d> direction_from_pixel(const Mei& mei, const Eigen::Vector2d& pixel_px) {
  if (!inside(mei.valid, mei.intrinsics, pixel_px)) return std::nullopt;
  const auto point = undistort(brown(mei), normalised(mei.intrinsics, pixel_px));
  if (!point) return std::nullopt;
  const double r2 = point->squaredNorm();
  const double discriminant = 1.0 + (1.0 - mei.xi * mei.xi) * r2;
  if (discriminant < 0.0) return std::nullopt;  // passes the sphere by
  const double along = (mei.xi + std::sqrt(discriminant)) / (r2 + 1.0);
  return Eigen::Vector3d(along * point->x(), along * point->y(), along - mei.xi).normalized();
}

std::optional<Eigen::Vector2d> pixel_from_direction(const Mei& mei, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d on_sphere = direction.normalized();
  // In front of the contour the picture is one-to-one: z > -1/xi for xi > 1, else z > -xi.
  const double contour = mei.xi > 1.0 ? -1.0 / mei.xi : -mei.xi;
  if (on_sphere.z() <= contour) return std::nullopt;
  const Distorted distorted = distort(brown(mei), on_sphere.head<2>() / (on_sphere.z() + mei.xi));
  if (distorted.jacobian.determinant() <= 0.0) return std::nullopt;
  const Eigen::Vector2d pixel_px = to_pixel(mei.intrinsics, distorted.point);
  if (!inside(mei.valid, mei.intrinsics, pixel_px)) return std::nullopt;
  return pixel_px;
}

}  // namespace homeward::camera
