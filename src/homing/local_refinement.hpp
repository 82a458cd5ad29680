// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/pose2.hpp"
#include "homing/local_map_config.hpp"

namespace homeward::homing {

struct RefinementFeature {
  Eigen::Vector3d target;     // bearing in the target's frame, unit
  double log_nearness = 0.0;  // logarithm of 1 / distance; refined
};
struct RefinementSighting {
  int feature = 0;
  Eigen::Vector3d here;
};
struct RefinementView {
  Pose2 target_from_robot;  // refined
  std::optional<Pose2> odometry;
  bool carried = false;  // odometry does not tell the way from the view before
  std::vector<RefinementSighting> sightings;
};
struct RefinementProblem {
  LocalMapConfig config;
  double first_distance_m = 1.0;  // of the first view from the target, as it was guessed
  double first_spread = 0.6;      // of its logarithm
  std::vector<RefinementFeature> features;
  std::vector<RefinementView> views;  // in the order of driving
};
struct RefinementResult {
  Eigen::Matrix3d covariance;  // of the last view's pose
  int inliers = 0;             // of the last view
};

/// Bundle adjustment on the floor: poses (x, y, theta) of all views and the features' distances from the target, by
/// bearings with a robust loss, odometry between views, the guess of the first distance and what is usual of distances
/// in rooms (Ceres, Levenberg-Marquardt with the features eliminated; one thread, so it is deterministic). The target's
/// frame stands still. Nothing where it does not converge to numbers; the problem is then as it was.
/// Triggs, McLauchlan, Hartley & Fitzgibbon, Bundle adjustment: a modern synthesis (2000).
std::optional<RefinementResult> refine_local_map(RefinementProblem& problem);

}  // namespace homeward::homing
