// SPDX-License-Identifier: Apache-2.0
#include "geometry/seen_point.hpp"

#include <Eigen/LU>
#include <limits>

namespace homeward::geometry {

Eigen::Vector2d offset_px(const SeenPoint& seen, const Eigen::Vector3d& bearing) {
  const double along = seen.bearing.dot(bearing);
  if (!(along > 0.0)) return Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  const auto& slope = seen.bearing_per_px;
  const Eigen::Matrix2d square = slope.transpose() * slope;
  return square.inverse() * (slope.transpose() * (bearing / along - seen.bearing));
}

}  // namespace homeward::geometry
