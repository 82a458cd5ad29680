// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "geometry/match_rows.hpp"
#include "geometry/planar_motion.hpp"

namespace homeward::geometry {

/// A planar motion between two views of which one may be tilted: a camera held by hand, a threshold, a soft tyre.
struct TiltedMotion {
  PlanarMotion planar;
  double elevation_rad = 0.0;  // of the direction to the target
  double roll_rad = 0.0;       // R = Rz(turn) Ry(pitch) Rx(roll)
  double pitch_rad = 0.0;

  [[nodiscard]] Eigen::Matrix3d rotation() const;   // takes target bearings into the current frame
  [[nodiscard]] Eigen::Vector3d direction() const;  // unit, towards the target
};

/// The angles of a tilted motion as a vector: direction, turn, elevation, roll, pitch.
using MotionAngles = Eigen::Matrix<double, 5, 1>;

/// The motion with its angles changed.
TiltedMotion moved(const TiltedMotion& motion, const MotionAngles& by);

/// First-order angular distances of a correspondence to the epipolar constraint of one motion.
/// Hartley & Zisserman, Multiple View Geometry (2004), §11.4.3 (Sampson distance), here for angles.
class EpipolarError {
 public:
  explicit EpipolarError(const TiltedMotion& motion);
  /// Signed, radians (Sampson).
  [[nodiscard]] double operator()(const Correspondence& correspondence) const;
  /// The same with its slope along each angle, the gradient that it is divided by held.
  [[nodiscard]] double operator()(const Correspondence& correspondence, MotionAngles& slope) const;
  [[nodiscard]] const Eigen::Matrix3d& essential() const { return essential_; }
  /// Of the essential matrix, column by column, along each angle.
  [[nodiscard]] const Eigen::Matrix<double, 5, 9>& slopes() const { return slopes_; }

 private:
  Eigen::Matrix3d essential_;
  Eigen::Matrix<double, 5, 9> slopes_;
};

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
std::vector<int> matches_within(double bound_rad, const TiltedMotion& motion, const MatchRows& matches);
std::vector<int> matches_within(double bound_rad, const TiltedMotion& motion,
                                std::span<const Correspondence> correspondences);

/// One Gauss-Newton step with Cauchy weights of `scale_rad`, all five angles free within the prior, on the matches
/// whose epipolar error is below `bound_rad`.
/// Iteratively reweighted least squares: Holland & Welsch (1977).
void refine_tilted(const MatchRows& matches, double bound_rad, double scale_rad, const TiltPrior& prior,
                   TiltedMotion& motion);

}  // namespace homeward::geometry
