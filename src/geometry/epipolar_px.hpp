// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "geometry/five_point.hpp"
#include "geometry/seen_point.hpp"

namespace homeward::geometry {

/// A change of a motion: of the turn about the target view's x, y and z (rotation vector, radians), and of the
/// direction along the two columns of `across`.
using MotionStep = Eigen::Matrix<double, 5, 1>;

/// That both views are from something that drives on a floor, mostly ahead or back: standard deviations. Frames with x
/// ahead and z up. It decides where the pairs do not, as between the two motions that explain what a single plane shows
/// (Hartley & Zisserman, 13.1).
struct DrivingPrior {
  double tilt_rad = 0.03;    // of the target view's vertical against the current one's, about either axis
  double climb_rad = 0.10;   // of the direction's elevation
  double swerve_rad = 0.15;  // of the direction's azimuth from straight ahead or back
};

/// How far pairs are from agreeing with a motion, in pixels of both pictures together: the first-order (Sampson)
/// approximation of the least reprojection error, signed (Hartley & Zisserman, 11.4.3).
class EpipolarPixels {
 public:
  explicit EpipolarPixels(const ViewMotion& motion);
  double operator()(const PointPair& pair) const;
  /// The same with its slope by a step.
  double operator()(const PointPair& pair, MotionStep& slope) const;
  /// The motion changed by a step.
  [[nodiscard]] ViewMotion moved(const MotionStep& by) const;
  /// Tilt about both axes, climb and swerve in standard deviations (sines of the angles), with their slopes by a step.
  [[nodiscard]] Eigen::Vector4d unlike_driving(const DrivingPrior& driving, Eigen::Matrix<double, 4, 5>& slope) const;

 private:
  ViewMotion motion_;
  Eigen::Matrix<double, 3, 2> across_;  // unit, at right angles to the direction and to each other
};

/// Sum of squares of a motion's tilt, climb and swerve in standard deviations; 0 without a prior.
double unlike_driving(const ViewMotion& motion, const std::optional<DrivingPrior>& driving);

/// A motion and what is known of it.
struct RefinedMotion {
  ViewMotion motion;
  double cost = 0.0;                                                              // sum of robust squared errors, px^2
  Eigen::Matrix<double, 5, 5> information = Eigen::Matrix<double, 5, 5>::Zero();  // of a step, for errors of 1 px
};

/// Levenberg and Marquardt's steps to the least sum of robust squared errors (Geman and McClure 1987: those of
/// `outlier_px` count half, those far off not at all) and of what is unlike driving, in errors of `spread_px`.
RefinedMotion refine(const ViewMotion& motion, std::span<const PointPair> pairs, double outlier_px,
                     const std::optional<DrivingPrior>& driving = {}, double spread_px = 1.0);

}  // namespace homeward::geometry
