// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "driving/body.hpp"

namespace homeward::driving {

/// The motion along one arc towards a goal in the robot frame, slower the sharper the arc (regulated pure pursuit,
/// Macenski et al., "Regulated pure pursuit for robot path tracking", Autonomous Robots 47, 2023). Smoother than the
/// way over a grid, but only where nothing is in the way: nothing when the goal does not lie ahead, or when the body
/// would have less room than is comfortable on the way there; that way has to be searched for (`steer_round`).
std::optional<Motion> pursue(const Body& body, std::span<const Eigen::Vector2d> points_m, const Eigen::Vector2d& goal_m,
                             double speed_mps);

}  // namespace homeward::driving
