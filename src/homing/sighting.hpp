// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace homeward::homing {

/// A feature of the target picture, seen from somewhere else.
struct Sighting {
  int feature = 0;                                    // its number in the target picture
  Eigen::Vector3d target = Eigen::Vector3d::UnitX();  // bearing in the target's robot frame, unit
  Eigen::Vector3d here = Eigen::Vector3d::UnitX();    // bearing in the present robot frame, unit
};

}  // namespace homeward::homing
