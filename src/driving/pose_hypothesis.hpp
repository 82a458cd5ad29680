// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "core/pose2.hpp"
#include "driving/twin_evidence.hpp"

namespace homeward::driving {

/// A robot's pose in the frame of a map, as one Gaussian.
struct PoseHypothesis {
  Pose2 map_from_robot;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  // of x, y (map frame, m) and heading (rad)
  double weight = 0.0;                                       // probability
  RecognitionRecord record = {};                             // of the pictures since it was begun
};

}  // namespace homeward::driving
