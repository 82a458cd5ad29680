// SPDX-License-Identifier: Apache-2.0
#include "geometry/planar_solver.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/angles.hpp"

namespace homeward::geometry {
namespace {

/// One motion from the two unit vectors of direction and of turn less direction, of any length and common sign.
PlanarMotion motion_from(const Eigen::Vector2d& direction, const Eigen::Vector2d& rest) {
  const double direction_rad = std::atan2(direction.y(), direction.x());
  return {direction_rad, wrap_angle(direction_rad + std::atan2(rest.y(), rest.x()))};
}

Eigen::Matrix2d adjugate(const Eigen::Matrix2d& m) {
  Eigen::Matrix2d result;
  result << m(1, 1), -m(0, 1), -m(1, 0), m(0, 0);
  return result;
}

}  // namespace

MinimalMotions solve_planar_motion(const std::array<Correspondence, 2>& pair) {
  // A u + B w = 0 with u = (cos f, sin f), w = (cos(turn - f), sin(turn - f)).
  Eigen::Matrix2d a;
  Eigen::Matrix2d b;
  for (Eigen::Index i = 0; i < 2; ++i) {
    const Correspondence& c = pair[static_cast<std::size_t>(i)];
    a.row(i) << -c.current.y() * c.target.z(), c.current.x() * c.target.z();
    b.row(i) << c.current.z() * c.target.y(), c.current.z() * c.target.x();
  }
  // The better conditioned of both is solved for: w det(B) = -adj(B) A u, or the same with the roles changed.
  const double det_a = a.determinant();
  const double det_b = b.determinant();
  const bool for_w = std::abs(det_b) >= std::abs(det_a);
  const double det = for_w ? det_b : det_a;
  const double size2 = a.squaredNorm() + b.squaredNorm();
  MinimalMotions motions;
  constexpr double kRounding = 1e-12;
  if (!(std::abs(det) > kRounding * size2)) return motions;
  const Eigen::Matrix2d solved_from_free =
      for_w ? Eigen::Matrix2d(adjugate(b) * a / -det) : Eigen::Matrix2d(adjugate(a) * b / -det);
  // |M v| = |v|: p x^2 + 2 q x y + r y^2 = 0 for the free vector v = (x, y).
  const Eigen::Matrix2d form = solved_from_free.transpose() * solved_from_free - Eigen::Matrix2d::Identity();
  const double p = form(0, 0);
  const double q = form(0, 1);
  const double r = form(1, 1);
  const auto add = [&](double x, double y) {
    const Eigen::Vector2d free(x, y);
    if (free.squaredNorm() < 1e-24) return;
    const Eigen::Vector2d solved = solved_from_free * free;
    motions.push_back(for_w ? motion_from(free, solved) : motion_from(solved, free));
  };
  // Views from one point: any direction will do. Take one.
  if (std::max({std::abs(p), std::abs(q), std::abs(r)}) < kRounding * (1.0 + solved_from_free.squaredNorm())) {
    add(1.0, 0.0);
    return motions;
  }
  const double discriminant = q * q - p * r;
  if (!(discriminant >= 0.0)) return motions;
  const double pivot = -(q + std::copysign(std::sqrt(discriminant), q));  // stable form of the two roots x : y
  add(pivot, p);
  add(r, pivot);
  return motions;
}

double epipolar_error_rad(const PlanarMotion& motion, const Correspondence& c) {
  // E = [t]x R of a planar motion has four entries: cosine and sine of the direction and of turn less direction.
  const double rest_rad = motion.turn_rad - motion.direction_rad;
  const double across_current =
      c.current.x() * std::sin(motion.direction_rad) - c.current.y() * std::cos(motion.direction_rad);
  const double across_target = c.target.x() * std::sin(rest_rad) + c.target.y() * std::cos(rest_rad);
  const double residual = c.target.z() * across_current + c.current.z() * across_target;
  // Tangential gradients with respect to both unit vectors: |E f2|^2 - r^2 and |E^T f1|^2 - r^2.
  const double gradient2 = c.target.z() * c.target.z() + across_target * across_target + c.current.z() * c.current.z() +
                           across_current * across_current - 2.0 * residual * residual;
  return std::abs(residual) / std::sqrt(std::max(gradient2, 1e-12));
}

}  // namespace homeward::geometry
