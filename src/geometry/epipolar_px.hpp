// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>

#include "geometry/five_point.hpp"
#include "geometry/seen_point.hpp"

namespace homeward::geometry {

/// A change of a motion: of the turn about the target view's x, y and z (rotation vector, radians), and of the
/// direction along the two columns of `across`.
using MotionStep = Eigen::Matrix<double, 5, 1>;

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

 private:
  ViewMotion motion_;
  Eigen::Matrix<double, 3, 2> across_;  // unit, at right angles to the direction and to each other
};

/// A motion and what is known of it.
struct RefinedMotion {
  ViewMotion motion;
  double cost = 0.0;                                                              // sum of robust squared errors, px^2
  Eigen::Matrix<double, 5, 5> information = Eigen::Matrix<double, 5, 5>::Zero();  // of a step, for errors of 1 px
};

/// Levenberg and Marquardt's steps to the least sum of robust squared errors (Geman and McClure 1987: those of
/// `outlier_px` count half, those far off not at all).
RefinedMotion refine(const ViewMotion& motion, std::span<const PointPair> pairs, double outlier_px);

}  // namespace homeward::geometry
