// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace homeward::geometry {

/// Planar motion between two views of a robot on a floor.
struct PlanarMotion {
  double direction_rad = 0.0;  // where the target viewpoint lies, in the present robot frame, (-pi, pi]
  double turn_rad = 0.0;       // target heading minus present heading, (-pi, pi]
};

/// A relative pose that enough correspondences agree with.
struct RelativePose {
  PlanarMotion motion;
  std::vector<int> inliers;          // indices into the correspondences given
  int correspondences = 0;           // how many were given
  double confidence = 0.0;           // probability that the direction is right within 15 degrees
  double median_parallax_rad = 0.0;  // over inliers, after taking the turn out; near 0: the two views coincide
};

}  // namespace homeward::geometry
