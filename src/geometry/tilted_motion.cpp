// SPDX-License-Identifier: Apache-2.0
#include "geometry/tilted_motion.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
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

std::vector<int> matches_within(double bound_rad, const TiltedMotion& motion, const MatchRows& matches) {
  std::vector<double> errors_rad;
  matches.errors(EpipolarError(motion), errors_rad);
  std::vector<int> within;
  for (std::size_t i = 0; i < errors_rad.size(); ++i) {
    if (std::abs(errors_rad[i]) < bound_rad) within.push_back(static_cast<int>(i));
  }
  return within;
}

std::vector<int> matches_within(double bound_rad, const TiltedMotion& motion,
                                std::span<const Correspondence> correspondences) {
  return matches_within(bound_rad, motion, MatchRows(correspondences));
}

void NormalEquations::add(double weight, double error, const double* slopes, std::size_t stride) {
  std::array<double, 5> weighted{};
  for (std::size_t a = 0; a < weighted.size(); ++a) weighted[a] = weight * slopes[a * stride];
  std::size_t next = 0;
  for (std::size_t a = 0; a < weighted.size(); ++a) {
    gradient_[a] += weighted[a] * error;
    for (std::size_t b = 0; b <= a; ++b) lower_[next++] += weighted[a] * slopes[b * stride];
  }
}

Eigen::Matrix<double, 5, 5> NormalEquations::curvature() const {
  Eigen::Matrix<double, 5, 5> whole;
  std::size_t next = 0;
  for (Eigen::Index a = 0; a < whole.rows(); ++a) {
    for (Eigen::Index b = 0; b <= a; ++b) whole(a, b) = whole(b, a) = lower_[next++];
  }
  return whole;
}

MotionAngles NormalEquations::gradient() const { return MotionAngles(gradient_.data()); }

void refine_tilted(const MatchRows& matches, double bound_rad, double scale_rad, const TiltPrior& prior,
                   TiltedMotion& motion) {
  thread_local std::vector<double> errors_rad;
  thread_local std::vector<double> slopes;
  matches.errors_and_slopes(EpipolarError(motion), errors_rad, slopes);
  NormalEquations equations;
  for (std::size_t i = 0; i < errors_rad.size(); ++i) {
    if (!(std::abs(errors_rad[i]) < bound_rad)) continue;
    const double ratio = errors_rad[i] / scale_rad;
    equations.add(1.0 / (1.0 + ratio * ratio), errors_rad[i], slopes.data() + i, errors_rad.size());
  }
  Eigen::Matrix<double, 5, 5> curvature = equations.curvature();
  MotionAngles gradient = equations.gradient();
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
  const MotionAngles step = (curvature + damping * Eigen::Matrix<double, 5, 5>::Identity()).ldlt().solve(gradient);
  constexpr double kMaxStepRad = 0.2;
  motion = moved(motion, -step.cwiseMax(-kMaxStepRad).cwiseMin(kMaxStepRad));
}

}  // namespace homeward::geometry
