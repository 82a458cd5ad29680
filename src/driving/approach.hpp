// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "driving/body.hpp"

namespace homeward::driving {

/// How the last decimetres to a destination are driven, and its heading is taken.
struct ApproachConfig {
  double within_m = 0.35;          // so near, the destination is driven to straight, backwards where it lies behind
  double turn_gain_per_s = 1.5;    // turn rate for each radian left,
  double most_turn_radps = 0.6;    // at most,
  double least_turn_radps = 0.12;  // and at least, where it turns in place
  double aligned_rad = 0.25;       // driven only with the destination that much ahead or behind
  double speed_gain_per_s = 0.7;   // speed for each metre left,
  double slowest_mps = 0.05;       // at least,
  double forward_mps = 0.2;        // and at most,
  double backward_mps = 0.1;       // backwards
  double room_m = 0.08;            // kept to things, or it stands: more than a door leaves
  double room_ahead_m = 0.05;      // so far on
};

/// The last bit of the way: turning towards the destination, or away from it where it lies behind, then straight.
/// `goal_m`: the destination, robot frame; `points_m`: what stands about the robot, robot frame.
Motion approach(const Eigen::Vector2d& goal_m, const Body& body, const std::vector<Eigen::Vector2d>& points_m,
                const ApproachConfig& config);

/// Turning in place to a heading that is `left_rad` away.
Motion turn_in_place(double left_rad, const ApproachConfig& config);

}  // namespace homeward::driving
