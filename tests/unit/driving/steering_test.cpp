// SPDX-License-Identifier: Apache-2.0
#include "driving/steering.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <vector>

#include "core/angles.hpp"
#include "core/pose2.hpp"
#include "driving/local_path.hpp"

namespace homeward::driving::steering_test {
namespace {

using Points = std::vector<Eigen::Vector2d>;

Points seen_by(const Points& world, const Pose2& robot, double noise_m, std::mt19937_64& random) {
  std::normal_distribution<double> noise(0.0, noise_m);
  Points seen;
  for (const Eigen::Vector2d& point : world) {
    const Pose2 at = inverse(robot) * Pose2{point.x(), point.y(), 0.0};
    const Eigen::Vector2d here(at.x_m, at.y_m);
    seen.push_back(here * (1.0 + noise(random) / std::max(0.1, here.norm())));
  }
  return seen;
}

/// Furniture: boxes of random size and heading, none nearer to the robot at the origin than `least_m`, one just so
/// near.
Points furniture(double least_m, std::mt19937_64& random) {
  std::uniform_real_distribution<double> across_m(-2.5, 2.5);
  std::uniform_real_distribution<double> side_m(0.3, 1.4);
  std::uniform_real_distribution<double> angle_rad(-kPi, kPi);
  Points points;
  for (int box = 0; box < 5; ++box) {
    Points outline;
    const double width_m = side_m(random);
    const double depth_m = side_m(random);
    const Pose2 at{across_m(random), across_m(random), angle_rad(random)};
    for (double t = 0.0; t < 1.0; t += 0.02) {
      for (const auto& [x, y] : {std::pair(t * width_m, 0.0), std::pair(t * width_m, depth_m),
                                 std::pair(0.0, t * depth_m), std::pair(width_m, t * depth_m)}) {
        const Pose2 corner = at * Pose2{x, y, 0.0};
        outline.emplace_back(corner.x_m, corner.y_m);
      }
    }
    // The first box is moved along the line to the robot until it stands as near as asked for; others only if too near.
    const auto nearest = *std::min_element(outline.begin(), outline.end(),
                                           [](const auto& a, const auto& b) { return a.norm() < b.norm(); });
    const bool move = box == 0 || nearest.norm() < least_m;
    const Eigen::Vector2d shift_m =
        move ? Eigen::Vector2d(nearest.normalized() * least_m - nearest) : Eigen::Vector2d(0.0, 0.0);
    for (const Eigen::Vector2d& point : outline) {
      const Eigen::Vector2d moved = point + shift_m;
      if (moved.norm() >= least_m - 1e-9) points.push_back(moved);
    }
  }
  return points;
}

/// The least room that a disc keeps from the origin to within 0.3 m of a goal, steering by a noisy sweep every 100 ms;
/// or nothing when it never gets there in half a minute.
std::optional<double> least_room_to_m(const Eigen::Vector2d& goal_m, const Points& world, std::mt19937_64& random) {
  const Body body;
  double least_room_m = 100.0;
  Pose2 pose{0.0, 0.0, std::uniform_real_distribution<double>(-kPi, kPi)(random)};
  constexpr double kCycle_s = 0.1;
  for (double t_s = 0.0; t_s < 30.0; t_s += kCycle_s) {
    const Points seen = seen_by(world, pose, 0.01, random);
    const Pose2 to = inverse(pose) * Pose2{goal_m.x(), goal_m.y(), 0.0};
    const Eigen::Vector2d aim_m(to.x_m, to.y_m);
    if (aim_m.norm() < 0.3) return least_room_m;
    least_room_m = std::min(least_room_m, clearance_m(body, seen_by(world, pose, 0.0, random)));
    const Motion motion = made_safe(steer_round(body, seen, aim_m, pose.theta_rad, 0.45, 1.8), body, seen);
    pose = pose * Pose2{motion.speed_mps * kCycle_s, 0.0, motion.turn_radps * kCycle_s};
  }
  return std::nullopt;
}

TEST(SteerRound, GetsAwayFromFurnitureItStandsCloseToAndReachesItsGoal) {
  int reachable = 0;
  for (std::uint64_t seed = 91; seed <= 140; ++seed) {  // the 115th stood still for good, heading past a corner
    std::mt19937_64 random(seed);
    const double room_m = std::uniform_real_distribution<double>(0.01, 0.06)(random);
    const Points world = furniture(Body().outline.radius_m + room_m, random);
    std::uniform_real_distribution<double> across_m(-1.5, 1.5);
    const Eigen::Vector2d goal_m(across_m(random), across_m(random));
    Body wider;  // so that it is no matter of a sweep's noise whether a gap is wide enough
    wider.outline.radius_m += 0.04;
    const auto way = local_way(wider, world, goal_m);
    if (!way || !way->reaches_goal) continue;
    ++reachable;
    EXPECT_TRUE(least_room_to_m(goal_m, world, random)) << "seed " << seed << ", " << room_m << " m of room";
  }
  EXPECT_GT(reachable, 10);
}

TEST(SteerRound, TurnsBeforeItDrivesWhereAnArcWouldCutACornerThatTheWayGoesRound) {
  const Body body;
  Points corner;  // of a piece of furniture, ahead on the right
  for (double along_m = 0.0; along_m < 0.5; along_m += 0.02) {
    corner.emplace_back(0.42 + along_m, -0.22);
    corner.emplace_back(0.42, -0.22 - along_m);
  }
  const Eigen::Vector2d goal_m(0.5, 0.3);
  ASSERT_GT(clearance_m(body, corner), 0.09);
  const Motion motion = steer_round(body, corner, goal_m, 0.0, 0.45, 1.8);
  EXPECT_GT(motion.turn_radps, 0.5);
  for (double seconds = 0.1; seconds < 0.85; seconds += 0.1) {
    EXPECT_GT(clearance_m(body, seen_after(corner, motion, seconds)), 0.075) << "after " << seconds << " s";
  }
  const double ahead_rad = std::atan2(goal_m.y(), goal_m.x());
  const Points turned = seen_after(corner, {0.0, ahead_rad}, 1.0);
  EXPECT_GT(steer_round(body, turned, {goal_m.norm(), 0.0}, ahead_rad, 0.45, 1.8).speed_mps, 0.1);
}

TEST(Steering, WhoeverStandsInACorridorIsWaitedForAndNoWayBehindItsWallsTried) {
  Points walls;
  for (double x_m = -1.0; x_m <= 2.5; x_m += 0.02) {
    walls.emplace_back(x_m, 0.6);
    walls.emplace_back(x_m, -0.6);
  }
  Points with_person = walls;
  for (double angle_rad = 0.5 * kPi; angle_rad <= 1.5 * kPi; angle_rad += 0.1) {
    with_person.emplace_back(1.2 + 0.2 * std::cos(angle_rad), 0.2 * std::sin(angle_rad));
  }
  const Body body;
  const Eigen::Vector2d goal_m(2.0, 0.0);
  EXPECT_GT(steer_round(body, walls, goal_m, 0.0, 0.45, 1.8).speed_mps, 0.3);
  ASSERT_TRUE(local_way(body, with_person, goal_m));
  EXPECT_TRUE(local_way(body, with_person, goal_m)->reaches_goal);
  const Motion before_person = steer_round(body, with_person, goal_m, 0.0, 0.45, 1.8);
  EXPECT_EQ(before_person.speed_mps, 0.0);
  EXPECT_EQ(before_person.turn_radps, 0.0);
  // Ultrasound's arcs close doors that are open: there it goes and looks.
  Body vague;
  vague.vague_ranges = true;
  EXPECT_NE(steer_round(vague, with_person, goal_m, 0.0, 0.45, 1.8).turn_radps, 0.0);
}

}  // namespace
}  // namespace homeward::driving::steering_test
