// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "geometry/relative_pose.hpp"

namespace homeward::geometry {

/// What robust estimation found.
struct PlanarEstimate {
  PlanarMotion motion;
  std::vector<int> inliers;           // ascending
  double median_parallax_rad = 0.0;   // over inliers, after the turn is taken out
  double direction_spread_rad = 0.0;  // standard deviation of the direction, from the residuals' curvature
  double forward_share = 0.0;         // of inliers with visible parallax that lie in front of both viewpoints
  double error_spread_rad = 0.0;      // standard deviation of the right matches' epipolar errors
  double tilt_rad = 0.0;              // between the views; 0 where the matches do not ask for any
  double height = 0.0;                // median of right matches over or under the camera, in units of the distance
  double agreeing = 0.0;              // share of all matches that agree with the motion
  bool general = false;               // not planar: see general_motion.hpp
  // Natural logarithms of how much likelier the matches are with this motion than
  double evidence = 0.0;       // at random, less what the search tried: matches that any motion explains add nothing
  double lead = 0.0;           // with the best motion found whose direction or turn is another
  double sign_log_odds = 0.0;  // with the direction reversed
};

}  // namespace homeward::geometry
