// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "core/outline.hpp"

namespace homeward::agent {

enum class Gear { kForward, kTurn, kReverse };

/// What to drive next, so that a body that is not round gets to a goal.
struct LongWay {
  Gear gear = Gear::kForward;
  Eigen::Vector2d aim_m = Eigen::Vector2d::Zero();  // forward and reverse: where the way leads next, robot frame
  double turn_rad = 0.0;                            // turning in place: by so much
  double length_m = 0.0;                            // of the whole way, turns not counted
  bool reaches_goal = false;                        // false: it ends where the goal is nearest
  int expanded = 0;                                 // poses that the search went on from
};

/// The cheapest way of a body that turns about its own origin among what one sweep saw, to a goal in the robot frame:
/// a search over poses (hybrid A*; Dolgov, Thrun, Montemerlo and Diebel, "Path planning for autonomous vehicles in
/// unknown semi-structured environments", IJRR 29(5), 2010, section 2) by short arcs, turns in place and reversing,
/// the last two dearer, and all of it dearer near things. The remaining way of its turning point over the floor leads
/// the search. Which way is cheapest does not depend on calls before: what is begun gets cheaper by being driven.
/// `heading_rad`: the robot's, in any frame that does not turn with it. Nothing when no pose nearer to the goal can be
/// reached.
std::optional<LongWay> long_way(const Outline& outline, std::span<const Eigen::Vector2d> points_m,
                                const Eigen::Vector2d& goal_m, double heading_rad = 0.0);

}  // namespace homeward::agent
