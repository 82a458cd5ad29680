// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/pose2.hpp"
#include "driving/body.hpp"
#include "driving/lattice.hpp"

namespace homeward::driving {

/// The way that a long body has begun. It is kept while it is free and no other is clearly cheaper: several ways round
/// things are often about as good, and deciding anew between them each time would lead nowhere.
struct LongPlan {
  std::vector<WayPose> poses;  // odometry's frame; empty: none
  std::size_t done = 0;        // the pose of it that the robot is at
  int age = 0;                 // calls since it was last compared with another
  Pose2 still_since;           // where the robot was when it last got on,
  int still = 0;               // so many calls ago
};

/// When a plan is kept, and how it is driven.
struct LongPlanConfig {
  int compare_every = 5;           // calls, and it is compared with another way,
  double cheaper_m = 0.5;          // which has to be cheaper by so much
  double apart_cost = 1.2;         // of a metre between the two ways' ends
  int still_for = 8;               // calls without getting on, after which another way is looked for;
  double on_m = 0.02;              // having driven by so much,
  double on_rad = 0.03;            // or turned, it has got on
  double astray_m = 0.12;          // so far from the way,
  double astray_rad = 0.35;        // or headed so much otherwise, it is on another one
  double there_rad = 0.05;         // from the heading that a turn in place is for
  double past_m = 0.03;            // the end of a stretch, it is behind the robot
  double least_clear_m = 0.05;     // room that has to be left along the way,
  double less_clear_m = 0.03;      // or as much less than was planned
  double look_m = 0.35;            // along the way, to where it is driven next;
  double nearest_m = 0.12;         // nearer than that, which way it lies says little
  double sharpest_per_m = 3.5;     // of the arcs driven
  double least_turn_radps = 0.12;  // in place,
  double turn_share = 0.6;         // of what the body may turn, at most
  double ending_mps = 0.08;        // at the end of a stretch, where it is to move in another way,
  double ending_gain_per_s = 0.8;  // and more for each metre before that
  double backward_mps = 0.2;       // at most
  double sideways_mps = 0.4;       // at most of the front in a bend,
  double least_front_m = 0.3;      // which lies at least so far ahead
};

/// The motion that leads on along the plan to a goal in the robot frame; the plan is made anew where it has to be.
/// Standing still, without a plan, where the goal cannot be got nearer to.
/// Pure pursuit of the plan (Coulter 1992); when it is kept is ours.
Motion steer_long(LongPlan& plan, const Body& body, std::span<const Eigen::Vector2d> points_m,
                  const Eigen::Vector2d& goal_m, const Pose2& odometry, double speed_mps, double turn_gain,
                  const LongPlanConfig& config = {});

}  // namespace homeward::driving
