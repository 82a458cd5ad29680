// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "core/outline.hpp"
#include "core/pose2.hpp"

namespace homeward::driving {

enum class Gear { kForward, kTurn, kReverse };

/// A pose of a way, and how it is reached from the one before.
struct WayPose {
  Pose2 pose;
  Gear gear = Gear::kForward;
  double cost_m = 0.0;   // of the way up to here, in metres driven forward where there is room
  double clear_m = 0.0;  // room beside the body, as far as it matters
};

/// How a body that is not round gets to a goal.
struct LongWay {
  std::vector<WayPose> poses;  // robot frame; the first is the robot's own
  bool reaches_goal = false;   // false: it ends where the goal is nearest
  int expanded = 0;            // poses that the search went on from
};

/// The cheapest way of a body that turns about its own origin among what one sweep saw, to a goal in the robot frame:
/// a search over poses (hybrid A*; Dolgov, Thrun, Montemerlo and Diebel, "Path planning for autonomous vehicles in
/// unknown semi-structured environments", IJRR 29(5), 2010, section 2) by short arcs, turns in place and reversing,
/// the last two dearer, and all of it dearer near things. The remaining way of its turning point over the floor leads
/// the search. `heading_rad`: the robot's, in any frame that does not turn with it. Nothing when no pose nearer to the
/// goal can be reached.
std::optional<LongWay> long_way(const Outline& outline, std::span<const Eigen::Vector2d> points_m,
                                const Eigen::Vector2d& goal_m, double heading_rad = 0.0);

}  // namespace homeward::driving
