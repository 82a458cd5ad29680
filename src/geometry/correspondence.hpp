// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

namespace homeward::geometry {

/// One feature seen from both viewpoints. Unit vectors in the robot frame of each.
struct Correspondence {
  Eigen::Vector3d current;
  Eigen::Vector3d target;
  double log_scale_ratio = 0.0;  // log of the feature's size in the target view over that in the current; 0: not known
  double odds = 1.0;             // factor on the odds that the match is right, from how it looks; 1: says nothing
};

}  // namespace homeward::geometry
