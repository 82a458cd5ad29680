// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "driving/twin_evidence.hpp"

namespace homeward::driving {

/// How the poses that a robot may be at are moved and weighed.
struct PoseHypothesesConfig {
  double odometry_m_per_sqrt_m = 0.04;  // standard deviations after a metre; they grow with the root of the way
  double odometry_rad_per_sqrt_m = 0.03;
  double odometry_rad_per_sqrt_rad = 0.03;  // and after a radian
  double least_position_m = 0.04;           // nothing is known better
  double least_heading_rad = 0.02;
  double bearing_rad = 0.06;  // standard deviations of a right direction
  double turn_rad = 0.05;
  double most_confidence = 0.9;     // of a direction: another place may look alike, however clear it is
  double near_view_m = 2.0;         // a view so near should have been recognised,
  double far_view_m = 8.0;          // and one so near may have been
  double gate = 4.0;                // standard deviations beyond which a sighting does not move a hypothesis
  double elsewhere_share = 0.03;    // of features recognised at views of other places than the robot's
  double shrinks_over_m = 2.0;      // from a view d away the share recognised is (1 + d / this)^-2 of that at it
  double elsewhere_evidence = 1.5;  // a picture speaks against being elsewhere by this power of the share
  TwinEvidenceConfig twins;
  double leave_probability = 0.002;  // for each independent picture
  double cluster_m = 1.0;            // hypotheses so near are one answer to where the robot is
  double independent_m = 0.4;        // pictures so far from each other say something new each
};

}  // namespace homeward::driving
