// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "driving/body.hpp"

namespace homeward::driving {

/// Where to head next, so that the body gets round what the sweep saw on its way to a goal.
struct LocalWay {
  Eigen::Vector2d carrot_m = Eigen::Vector2d::Zero();  // a point of the way some steps ahead, robot frame
  double length_m = 0.0;                               // of the way
  bool reaches_goal = false;                           // false: it ends at the free point nearest to the goal
};

/// The cheapest way over a grid of what one sweep saw, to a goal in the robot frame (Dijkstra; cells near things cost
/// more, so ways keep to the middle of doors), for a round body; of another only the radius counts. `heading_rad`: the
/// robot's, in any frame that does not turn with it. Nothing when the robot is walled in.
/// Dijkstra (1959); what is asked beside it is ours.
std::optional<LocalWay> local_way(const Body& body, std::span<const Eigen::Vector2d> points_m,
                                  const Eigen::Vector2d& goal_m, double heading_rad = 0.0);

}  // namespace homeward::driving
