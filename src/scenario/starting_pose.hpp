// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/result.hpp"
#include "sim/motion.hpp"
#include "sim/scene.hpp"

namespace homeward::scenario {

inline constexpr double kStartClearance_m = 0.05;

/// A pose near a room's point, any heading, in which nothing comes nearer to the robot's body than kStartClearance_m:
/// within 0.3 m of the point where that is possible, within 1 m else. `world`: as it truly is during the mission.
/// Same seed, same pose. Errors: kInvalidInput where the robot does not fit.
Result<Pose2> starting_pose(const sim::World& world, const Eigen::Vector2d& point_m, const sim::RobotProfile& robot,
                            std::uint64_t seed);
/// The same of a world whose obstacles are at hand.
Result<Pose2> starting_pose(const sim::World& world, const sim::Obstacles& obstacles, const Eigen::Vector2d& point_m,
                            const sim::RobotProfile& robot, std::uint64_t seed);

}  // namespace homeward::scenario
