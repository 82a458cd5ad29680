// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>

#include "core/pose2.hpp"

namespace homeward::driving {

/// Where a view lies by the matches of one picture.
struct SightedDirection {
  double bearing_rad = 0.0;  // of the view, robot frame
  double turn_rad = 0.0;     // from the robot's heading to the view's
  double confidence = 0.0;   // probability that both are right, given that the robot is near the view
  double distance_m = 1.0;   // what the share of features recognised says; known to a factor of two
};

/// Where a view lies by a local map of its features (homing::LocalMap).
struct SightedPose {
  Pose2 robot_from_view;
  Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Identity();  // of the position, robot frame
};

/// One view of the map that the latest picture was compared with.
struct ViewSighting {
  Pose2 map_from_view;
  double spread_m = 0.15;     // standard deviation of where the view lies among those around it
  double share = 0.0;         // of the features of picture and view, those that one motion explains,
  int agreeing = 0;           // and how many those are
  double prior_share = 1e-3;  // of the probability: that the robot is at this view although no hypothesis said so
  std::optional<SightedDirection> direction;
  std::optional<SightedPose> pose;
};

}  // namespace homeward::driving
