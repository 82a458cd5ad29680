// SPDX-License-Identifier: Apache-2.0
#include "geometry/tilted_motion.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/angles.hpp"

namespace homeward::geometry {
namespace {

using Angles = Eigen::Matrix<double, 5, 1>;  // direction, turn, elevation, roll, pitch

TiltedMotion moved(const TiltedMotion& motion, const Angles& by) {
  return {{wrap_angle(motion.planar.direction_rad + by[0]), wrap_angle(motion.planar.turn_rad + by[1])},
          motion.elevation_rad + by[2],
          motion.roll_rad + by[3],
          motion.pitch_rad + by[4]};
}

}  // namespace

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
  Eigen::Matrix3d cross;
  cross << 0.0, -t.z(), t.y(), t.z(), 0.0, -t.x(), -t.y(), t.x(), 0.0;
  essential_ = cross * motion.rotation();
}

double EpipolarError::operator()(const Correspondence& correspondence) const {
  const Eigen::Vector3d line_in_current = essential_ * correspondence.target;
  const Eigen::Vector3d line_in_target = essential_.transpose() * correspondence.current;
  const double residual = correspondence.current.dot(line_in_current);
  // Tangential gradients with respect to both unit vectors: |E f2|^2 - r^2 and |E^T f1|^2 - r^2.
  const double gradient2 = line_in_current.squaredNorm() + line_in_target.squaredNorm() - 2.0 * residual * residual;
  return residual / std::sqrt(std::max(gradient2, 1e-12));
}

Eigen::Matrix2d refine_tilted(std::span<const Correspondence> correspondences, const std::vector<int>& inliers,
                              double scale_rad, const TiltPrior& prior, TiltedMotion& motion) {
  constexpr double kStepRad = 1e-6;
  const EpipolarError here(motion);
  std::array<EpipolarError, 5> beside = {here, here, here, here, here};
  for (Eigen::Index i = 0; i < 5; ++i) {
    beside[static_cast<std::size_t>(i)] = EpipolarError(moved(motion, kStepRad * Angles::Unit(i)));
  }
  Eigen::Matrix<double, 5, 5> curvature = Eigen::Matrix<double, 5, 5>::Zero();
  Angles gradient = Angles::Zero();
  for (const int index : inliers) {
    const Correspondence& c = correspondences[static_cast<std::size_t>(index)];
    const double error_rad = here(c);
    Angles slope;
    for (Eigen::Index i = 0; i < 5; ++i) {
      slope[i] = (beside[static_cast<std::size_t>(i)](c) - error_rad) / kStepRad;
    }
    const double ratio = error_rad / scale_rad;
    const double weight = 1.0 / (1.0 + ratio * ratio);
    curvature += weight * slope * slope.transpose();
    gradient += weight * error_rad * slope;
  }
  // The prior in the same units: residuals count in units of their scale.
  const auto hold = [&](Eigen::Index i, double value_rad, double spread_rad) {
    const double weight = scale_rad * scale_rad / (spread_rad * spread_rad);
    curvature(i, i) += weight;
    gradient[i] += weight * value_rad;
  };
  hold(2, motion.elevation_rad, prior.elevation_rad);
  hold(3, motion.roll_rad, prior.tilt_rad);
  hold(4, motion.pitch_rad, prior.tilt_rad);
  // A little damping keeps the direction where it is when the views coincide and it means nothing.
  const double damping = 1e-9 * (curvature.trace() + 1.0);
  const Angles step = (curvature + damping * Eigen::Matrix<double, 5, 5>::Identity()).ldlt().solve(gradient);
  constexpr double kMaxStepRad = 0.2;
  motion = moved(motion, -step.cwiseMax(-kMaxStepRad).cwiseMin(kMaxStepRad));
  const Eigen::Matrix3d tilts = curvature.bottomRightCorner<3, 3>();
  return curvature.topLeftCorner<2, 2>() -
         curvature.topRightCorner<2, 3>() * tilts.ldlt().solve(curvature.bottomLeftCorner<3, 2>());
}

}  // namespace homeward::geometry
