// SPDX-License-Identifier: Apache-2.0
#include "geometry/tilted_refinement.hpp"

#include <Eigen/Dense>
#include <cmath>

namespace homeward::geometry {

std::vector<int> matches_within(double bound_rad, const TiltedMotion& motion,
                                std::span<const Correspondence> correspondences) {
  std::vector<double> errors_rad;
  MatchRows(correspondences).errors(EpipolarError(motion), errors_rad);
  std::vector<int> within;
  for (std::size_t i = 0; i < errors_rad.size(); ++i) {
    if (std::abs(errors_rad[i]) < bound_rad) within.push_back(static_cast<int>(i));
  }
  return within;
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
