// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "driving/pose_hypotheses_config.hpp"
#include "driving/view_track.hpp"
#include "homing/home_vector.hpp"
#include "homing/visual_homing.hpp"

namespace homeward::driving {

/// No more probable than that is where the robot is by the estimates of others alone: they are of the same pictures,
/// and two halves of a building may look alike.
inline constexpr double kMostByOthers = 0.85;

/// How a robot finds out where it is on its path, and homes to the views of it.
struct FollowConfig {
  homing::HomingConfig homing;
  homing::VisualHomingConfig visual;
  ViewTrackConfig track;
  PoseHypothesesConfig pose;
  double pass_m = 0.5;     // a view on the way is passed within this distance
  double abreast_m = 1.1;  // or when the robot is level with it within this one
  // A view that the robot is believed to be near to: what stands against its being another place that looks alike.
  double path_odds = 4.0;  // the odds of an answer's confidence are multiplied by these
  double believe = 0.5;    // below that an answer says nothing
  double sure = 0.8;       // confidence of a clear answer, after that
  int sure_inliers = 24;
  int look_along = 3;         // views of the path that the robot may be at, before and after the one homed to
  int most_compared = 10;     // views that one picture is compared with
  double blind_m = 1.6;       // so far the robot drives on by odometry when no view answers
  double reached_m = 0.03;    // the destination's view is reached within this distance, where it is measured
  double nearby_m = 1.0;      // the destination's view counts as reached or left behind only when it must be so near
  double alike_share = 0.35;  // of the features that agree where two views coincide
  double drive_above = 0.7;   // probability of where the robot is below which it looks around,
  double likelier = 0.5;      // and, where it has looked around in vain, below which it goes on looking
  double leap_above = 0.9;    // and from which on it goes on from quite another piece of its path
  double arrived_within_m = 0.5;      // of the destination the robot is when it says that it has arrived,
  double arrived_probability = 0.97;  // with at least this probability
};

}  // namespace homeward::driving
