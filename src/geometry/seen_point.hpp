// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace homeward::geometry {

/// A point as one picture of a central camera shows it, with what a pixel means there: so that geometry on bearings can
/// be judged in pixels, whatever the lens.
struct SeenPoint {
  Eigen::Vector3d bearing = Eigen::Vector3d::UnitX();                                // unit
  Eigen::Matrix<double, 3, 2> bearing_per_px = Eigen::Matrix<double, 3, 2>::Zero();  // by pixel right, by pixel down
};

/// The same point in two pictures.
struct PointPair {
  SeenPoint current;
  SeenPoint target;
};

/// How many pixels a bearing lies from where the point is seen, to first order. Not finite where the bearing is a right
/// angle or more away.
Eigen::Vector2d offset_px(const SeenPoint& seen, const Eigen::Vector3d& bearing);

}  // namespace homeward::geometry
