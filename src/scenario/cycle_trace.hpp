// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/pose2.hpp"

namespace homeward::scenario {

/// One control cycle of a mission, for whoever wants to see why it went as it did.
struct CycleTrace {
  double t_s = 0.0;
  Pose2 pose;  // true
  int index = 0;
  int views = 0;
  std::string view;  // the picture homed to
  bool answered = false;
  bool measured = false;              // the view homed to, in metres
  double position_probability = 0.0;  // of where the robot believes to be
  double arrival_probability = 0.0;
  double elsewhere = 0.0;
  std::optional<double> continuity;        // share of features seen again from the picture before
  std::optional<double> off_belief_m;      // between a sure belief and a sure estimate
  std::optional<double> contradiction;     // of the latest sweep and the one before
  std::optional<double> estimate_error_m;  // true
  double bearing_rad = 0.0;
  double confidence = 0.0;
  int inliers = 0;
  double parallax_rad = 0.0;
  double goal_x_m = 0.0;  // robot frame
  double goal_y_m = 0.0;
  double speed_mps = 0.0;  // commanded
  double turn_radps = 0.0;
  double min_range_m = 0.0;
  double clearance_m = 0.0;               // least so far, true
  std::vector<Eigen::Vector2d> people_m;  // true
  std::string state;
};

}  // namespace homeward::scenario
