// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "geometry/correspondence.hpp"
#include "geometry/relative_pose.hpp"

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

}  // namespace homeward::geometry
