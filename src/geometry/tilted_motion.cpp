// SPDX-License-Identifier: Apache-2.0
#include "geometry/tilted_motion.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/angles.hpp"

namespace homeward::geometry {
namespace {

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

double angular(double residual, const Eigen::Vector3d& line_in_current, const Eigen::Vector3d& line_in_target) {
  // Tangential gradients with respect to both unit vectors: |E f2|^2 - r^2 and |E^T f1|^2 - r^2.
  const double gradient2 = line_in_current.squaredNorm() + line_in_target.squaredNorm() - 2.0 * residual * residual;
  return 1.0 / std::sqrt(std::max(gradient2, 1e-12));
}

}  // namespace

TiltedMotion moved(const TiltedMotion& motion, const MotionAngles& by) {
  return {{wrap_angle(motion.planar.direction_rad + by[0]), wrap_angle(motion.planar.turn_rad + by[1])},
          motion.elevation_rad + by[2],
          motion.roll_rad + by[3],
          motion.pitch_rad + by[4]};
}

Eigen::Matrix3d TiltedMotion::rotation() const {
  return (Eigen::AngleAxisd(planar.turn_rad, Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

Eigen::Vector3d TiltedMotion::direction() const {
  return {std::cos(elevation_rad) * std::cos(planar.direction_rad),
          std::cos(elevation_rad) * std::sin(planar.direction_rad), std::sin(elevation_rad)};
}

EpipolarError::EpipolarError(const TiltedMotion& motion) {
  const Eigen::Vector3d t = motion.direction();
  const Eigen::Matrix3d rotation = motion.rotation();
  essential_ = cross_matrix(t) * rotation;
  const double cos_e = std::cos(motion.elevation_rad);
  const double sin_e = std::sin(motion.elevation_rad);
  const double cos_d = std::cos(motion.planar.direction_rad);
  const double sin_d = std::sin(motion.planar.direction_rad);
  // A turn of R about an axis k given in the current frame adds [k]x R: z for the turn, the turned y for the pitch,
  // and the turned and pitched x, which is R's first column, for the roll.
  const Eigen::Vector3d pitch_axis(-std::sin(motion.planar.turn_rad), std::cos(motion.planar.turn_rad), 0.0);
  const auto set = [&](Eigen::Index angle, const Eigen::Matrix3d& m) {
    slopes_.row(angle) = Eigen::Map<const Eigen::Matrix<double, 1, 9>>(m.data());
  };
  set(0, cross_matrix({-cos_e * sin_d, cos_e * cos_d, 0.0}) * rotation);
  set(1, cross_matrix(t) * cross_matrix(Eigen::Vector3d::UnitZ()) * rotation);
  set(2, cross_matrix({-sin_e * cos_d, -sin_e * sin_d, cos_e}) * rotation);
  set(3, cross_matrix(t) * cross_matrix(rotation.col(0)) * rotation);
  set(4, cross_matrix(t) * cross_matrix(pitch_axis) * rotation);
}

double EpipolarError::operator()(const Correspondence& correspondence) const {
  const Eigen::Vector3d line_in_current = essential_ * correspondence.target;
  const Eigen::Vector3d line_in_target = essential_.transpose() * correspondence.current;
  const double residual = correspondence.current.dot(line_in_current);
  return residual * angular(residual, line_in_current, line_in_target);
}

double EpipolarError::operator()(const Correspondence& correspondence, MotionAngles& slope) const {
  const Eigen::Vector3d line_in_current = essential_ * correspondence.target;
  const Eigen::Vector3d line_in_target = essential_.transpose() * correspondence.current;
  const double residual = correspondence.current.dot(line_in_current);
  const double per_gradient = angular(residual, line_in_current, line_in_target);
  Eigen::Matrix<double, 9, 1> product;  // current times target transposed, column by column
  product << correspondence.current * correspondence.target.x(), correspondence.current * correspondence.target.y(),
      correspondence.current * correspondence.target.z();
  slope = per_gradient * (slopes_ * product);
  return residual * per_gradient;
}

}  // namespace homeward::geometry
