// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "geometry/five_point.hpp"
#include "geometry/seen_point.hpp"

namespace homeward::geometry {

/// Where two rays meet, once both are turned by as little as possible so that they do.
struct MeetingRays {
  Eigen::Vector3d current;    // unit, in the current view's frame
  Eigen::Vector3d target;     // unit, in the target view's frame
  double nearness = 0.0;      // 1 / distance from the current viewpoint, in units of 1 / the distance between the two
                              // viewpoints; 0: parallel, negative: they part and would meet behind
  double from_target = 0.0;   // the same from the target viewpoint
  double parallax_rad = 0.0;  // between the rays
};

/// The least sum of squared sines of the angles by which the rays are turned: closed form (Lee & Civera 2019, §V).
/// `target` is where the bearing is seen in the target view's frame; both unit.
MeetingRays triangulate(const ViewMotion& motion, const Eigen::Vector3d& current, const Eigen::Vector3d& target);

/// How far what is seen lies from what would be if the rays met: squared pixels, of both pictures together (the
/// reprojection error of Hartley & Zisserman, 4.2.3).
double reprojection_px2(const PointPair& pair, const MeetingRays& rays);

}  // namespace homeward::geometry
