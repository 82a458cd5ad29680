// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "geometry/match_rows.hpp"
#include "geometry/tilt_prior.hpp"
#include "geometry/tilted_motion.hpp"

namespace homeward::geometry {

struct FitConfig {
  double start_spread_rad = 0.003;   // of the residuals of right matches
  double least_spread_rad = 0.0003;  // no eye is more exact
  double most_spread_rad = 0.0045;
  double least_chance = 0.01;  // no match says more than this
  TiltPrior tilt;
  bool level = false;  // tilts are none
  int steps = 6;
};

/// A motion with how much it explains.
struct MotionFit {
  TiltedMotion motion;
  double spread_rad = 0.0;
  double share = 0.0;           // of right matches among those that can tell and whose look says nothing
  std::vector<double> belief;   // that a match is right
  double log_likelihood = 0.0;  // over that of matches at random, the prior of tilts included
  double greatest_gain = 0.0;   // the most that one match adds to it
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();  // of direction and turn, tilts taken out
};

/// Expectation maximisation from `start`. Right matches have residuals of one spread, lie in front of both viewpoints
/// and change their size as they come nearer; wrong ones are as likely at any turn about the vertical, on either side,
/// and of any size (Torr & Zisserman, MLESAC, 2000, with an outlier density for each match, and with a share of right
/// ones for each match: Tordoff & Murray, Guided-MLESAC, 2005). The direction may come out
/// reversed: that with more matches in front is taken.
MotionFit fit_motion(const MatchRows& matches, const TiltedMotion& start, const FitConfig& config);

}  // namespace homeward::geometry
