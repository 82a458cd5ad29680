// SPDX-License-Identifier: Apache-2.0
#include "scenario/starting_pose.hpp"

#include "core/angles.hpp"
#include "sim/floor.hpp"
#include "sim/random.hpp"

namespace homeward::scenario {

Result<Pose2> starting_pose(const sim::World& world, const Eigen::Vector2d& point_m, const sim::RobotProfile& robot,
                            std::uint64_t seed) {
  return starting_pose(world, sim::Obstacles(world), point_m, robot, seed);
}

Result<Pose2> starting_pose(const sim::World& world, const sim::Obstacles& obstacles, const Eigen::Vector2d& point_m,
                            const sim::RobotProfile& robot, std::uint64_t seed) {
  sim::Random random(seed);
  constexpr int kTries = 600;
  constexpr int kNearTries = 200;
  for (int attempt = 0; attempt < kTries; ++attempt) {
    const double within_m = attempt < kNearTries ? 0.3 : 1.0;
    const double east_m = sim::uniform(random, -within_m, within_m);
    const double north_m = sim::uniform(random, -within_m, within_m);
    const Eigen::Vector2d at_m = point_m + Eigen::Vector2d(east_m, north_m);
    if (!sim::is_set(world.drivable, at_m)) continue;
    const Pose2 pose{at_m.x(), at_m.y(), sim::uniform(random, -kPi, kPi)};
    if (obstacles.clearance_of_cells_m(robot, pose) >= kStartClearance_m) return pose;
  }
  return fail(ErrorCode::kInvalidInput,
              "No pose within 1 m of the room's point leaves the " + robot.name + " 0.05 m of room to start from.",
              "missions/from");
}

}  // namespace homeward::scenario
