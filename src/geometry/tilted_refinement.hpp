// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "geometry/correspondence.hpp"
#include "geometry/match_rows.hpp"
#include "geometry/tilt_prior.hpp"
#include "geometry/tilted_motion.hpp"

namespace homeward::geometry {

/// Sums of weighted squares of slopes along a motion's angles, and of slopes times errors.
class NormalEquations {
 public:
  /// One match; its slopes lie `stride` numbers apart.
  void add(double weight, double error, const double* slopes, std::size_t stride);
  [[nodiscard]] Eigen::Matrix<double, 5, 5> curvature() const;
  [[nodiscard]] MotionAngles gradient() const;

 private:
  std::array<double, 15> lower_{};  // triangle of the curvature, row by row
  std::array<double, 5> gradient_{};
};

/// The matches whose epipolar error is below the bound, ascending.
std::vector<int> matches_within(double bound_rad, const TiltedMotion& motion,
                                std::span<const Correspondence> correspondences);

/// One Gauss-Newton step with Cauchy weights of `scale_rad`, all five angles free within the prior, on the matches
/// whose epipolar error is below `bound_rad`.
/// Iteratively reweighted least squares: Holland & Welsch (1977).
void refine_tilted(const MatchRows& matches, double bound_rad, double scale_rad, const TiltPrior& prior,
                   TiltedMotion& motion);

}  // namespace homeward::geometry
