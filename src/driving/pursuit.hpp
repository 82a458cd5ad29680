// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "driving/body.hpp"

namespace homeward::driving {

/// When a way is clear enough to be driven straight, and how.
struct PursuitConfig {
  double ahead_rad = 0.6;     // a goal further aside is turned to first
  double least_look_m = 0.4;  // the arc's chord
  double most_look_m = 1.0;
  double farthest_m = 2.0;        // beyond that the way may change before the robot is there
  double beyond_m = 1.5;          // things so far beyond it may still reach into the body's way
  double room_m = 0.2;            // beside the body; with less the middle of the way is looked for
  double step_m = 0.1;            // from one pose that is tried to the next
  double comfort_radius_m = 0.8;  // sharper arcs are driven slower,
  double slowest_share = 0.3;     // by this share of the speed at least
};

/// The motion along one arc towards a goal in the robot frame, slower the sharper the arc (regulated pure pursuit,
/// Macenski et al., "Regulated pure pursuit for robot path tracking", Autonomous Robots 47, 2023). Smoother than the
/// way over a grid, but only where nothing is in the way: nothing when the goal does not lie ahead, or when the body
/// would have less room than is comfortable on the way there; that way has to be searched for (`steer_round`).
std::optional<Motion> pursue(const Body& body, std::span<const Eigen::Vector2d> points_m, const Eigen::Vector2d& goal_m,
                             double speed_mps, const PursuitConfig& config = {});

}  // namespace homeward::driving
