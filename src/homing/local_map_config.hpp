// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace homeward::homing {

/// What a local map takes features, pictures and odometry for.
struct LocalMapConfig {
  double bearing_spread_rad = 0.005;  // of a feature's bearing, as matches across metres have it
  double inlier_rad = 0.02;           // bearings further off belong to something else
  int fewest = 8;                     // features that a pose must explain
  double fewest_share = 0.3;          // and their share of those given
  int ransac_rounds = 60;
  int keyframes = 8;                   // pictures that the map is refined over
  double keyframe_m = 0.1;             // driven between two of them
  double usual_distance_m = 2.5;       // of features in rooms; what is known before anything is measured
  double usual_distance_spread = 1.0;  // of the logarithm of that
  double odometry_share = 0.03;        // spread of odometry, of the way driven
  double odometry_least_m = 0.004;     // and at least
  double odometry_turn_rad_per_m = 0.03;
  double odometry_least_turn_rad = 0.004;
};

}  // namespace homeward::homing
