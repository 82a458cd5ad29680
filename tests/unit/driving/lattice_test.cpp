// SPDX-License-Identifier: Apache-2.0
#include "driving/lattice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <vector>

#include "core/angles.hpp"
#include "core/pose2.hpp"
#include "driving/steering.hpp"

namespace homeward::driving::lattice_test {
namespace {

using Points = std::vector<Eigen::Vector2d>;

constexpr double kCycle_s = 0.1;

Body chair() {
  Body body;
  body.outline = {0.0, 0.25, 0.85, 0.325};
  return body;
}

void add_wall(Points& points, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const int count = static_cast<int>((to - from).norm() / 0.01);
  for (int i = 0; i <= count; ++i) points.emplace_back(from + (to - from) * i / std::max(1, count));
}

/// What a sweep of 360 rays from the turning point sees of them: in each direction the nearest, with noise.
Points swept(const Points& world, const Pose2& robot, std::mt19937_64& random) {
  std::normal_distribution<double> noise_m(0.0, 0.01);
  std::vector<double> ranges_m(360, 1e9);
  const Pose2 from_world = inverse(robot);
  for (const Eigen::Vector2d& point : world) {
    const Pose2 at = from_world * Pose2{point.x(), point.y(), 0.0};
    const int ray = static_cast<int>(std::lround(std::atan2(at.y_m, at.x_m) * 180.0 / kPi) + 360) % 360;
    double& range_m = ranges_m[static_cast<std::size_t>(ray)];
    range_m = std::min(range_m, std::hypot(at.x_m, at.y_m));
  }
  Points seen;
  for (int ray = 0; ray < 360; ++ray) {
    const double range_m = ranges_m[static_cast<std::size_t>(ray)] + noise_m(random);
    if (range_m < 12.0) seen.emplace_back(range_m * std::cos(ray * kPi / 180.0), range_m * std::sin(ray * kPi / 180.0));
  }
  return seen;
}

struct Drive {
  std::optional<double> arrived_s;
  double least_clearance_m = 1e9;
  double reversed_m = 0.0;
  int changes = 0;  // between forward and reverse
  Pose2 end;
};

/// A chair from a pose to a goal, as `step` drives it: a noisy sweep every 100 ms, motion with bounded acceleration.
Drive drive(const Body& body, const Points& world, Pose2 pose, const Eigen::Vector2d& goal_m, double longest_s = 60.0) {
  std::mt19937_64 random(5);
  Drive result;
  Motion motion;
  LongPlan plan;
  double before_mps = 0.0;
  for (double t_s = 0.0; t_s < longest_s; t_s += kCycle_s) {
    const Pose2 to = inverse(pose) * Pose2{goal_m.x(), goal_m.y(), 0.0};
    const Eigen::Vector2d aim_m(to.x_m, to.y_m);
    result.end = pose;
    if (aim_m.norm() < 0.25) {
      result.arrived_s = t_s;
      return result;
    }
    const Points seen = swept(world, pose, random);
    const Motion steered = steer_round(plan, body, seen, aim_m, pose, 0.45, 1.8);
    const Motion wanted = made_safe(steered, body, seen, motion.turn_radps);
    if (wanted.speed_mps * before_mps < 0.0) ++result.changes;
    if (wanted.speed_mps != 0.0) before_mps = wanted.speed_mps;
    const auto nearer = [](double now, double then, double step) { return now + std::clamp(then - now, -step, step); };
    for (int k = 0; k < 5; ++k) {
      constexpr double kStep_s = kCycle_s / 5.0;
      motion.speed_mps = nearer(motion.speed_mps, wanted.speed_mps, 1.0 * kStep_s);
      motion.turn_radps = nearer(motion.turn_radps, wanted.turn_radps, 2.5 * kStep_s);
      const Pose2 half{0.0, 0.0, 0.5 * motion.turn_radps * kStep_s};
      pose = pose * half * Pose2{motion.speed_mps * kStep_s, 0.0, 0.0} * half;
      result.reversed_m += std::max(0.0, -motion.speed_mps * kStep_s);
      Points around;
      const Pose2 from_world = inverse(pose);
      for (const Eigen::Vector2d& point : world) {
        const Pose2 at = from_world * Pose2{point.x(), point.y(), 0.0};
        around.emplace_back(at.x_m, at.y_m);
      }
      result.least_clearance_m = std::min(result.least_clearance_m, clearance_m(body, around));
    }
  }
  return result;
}

/// A corridor of 1.5 m along x, and in its left wall a door of 0.85 m, 0.12 m deep, into a room.
Points corridor_with_door() {
  Points points;
  add_wall(points, {-2.5, -0.75}, {4.5, -0.75});
  add_wall(points, {-2.5, 0.75}, {1.575, 0.75});
  add_wall(points, {2.425, 0.75}, {4.5, 0.75});
  add_wall(points, {1.575, 0.75}, {1.575, 0.87});
  add_wall(points, {2.425, 0.75}, {2.425, 0.87});
  add_wall(points, {0.0, 0.87}, {1.575, 0.87});
  add_wall(points, {2.425, 0.87}, {4.0, 0.87});
  add_wall(points, {0.0, 0.87}, {0.0, 4.0});
  add_wall(points, {4.0, 0.87}, {4.0, 4.0});
  add_wall(points, {0.0, 4.0}, {4.0, 4.0});
  add_wall(points, {4.5, -0.75}, {4.5, 0.75});
  add_wall(points, {-2.5, -0.75}, {-2.5, 0.75});
  return points;
}

TEST(LongWay, IsStraightWhereNothingStands) {
  const auto way = long_way(chair().outline, {}, {2.0, 0.0});
  ASSERT_TRUE(way);
  EXPECT_TRUE(way->reaches_goal);
  EXPECT_NEAR(way->poses.back().pose.x_m, 2.0, 0.13);
  for (std::size_t i = 1; i < way->poses.size(); ++i) {
    EXPECT_EQ(way->poses[i].gear, Gear::kForward);
    EXPECT_NEAR(way->poses[i].pose.y_m, 0.0, 0.02);
  }
}

TEST(LongWay, DoesNotDependOnTheAxesOfOdometry) {
  const Points world = corridor_with_door();
  std::mt19937_64 random(1);
  const Points seen = swept(world, {0.0, 0.0, 0.3}, random);
  for (double heading_rad = -3.0; heading_rad < 3.0; heading_rad += 0.37) {
    const auto way = long_way(chair().outline, seen, {1.5, -0.3}, heading_rad);
    ASSERT_TRUE(way) << heading_rad;
    EXPECT_TRUE(way->reaches_goal) << heading_rad;
    EXPECT_EQ(way->poses[1].gear, Gear::kForward) << heading_rad;
    EXPECT_NEAR(way->poses[0].pose.theta_rad, 0.0, 1e-6) << heading_rad;
  }
}

TEST(ALongBody, PassesADoorOf85CentimetresFromACorridor) {
  for (const double heading_rad : {0.0, kPi, 0.4}) {
    const Drive driven = drive(chair(), corridor_with_door(), {0.0, 0.0, heading_rad}, {2.0, 2.5});
    EXPECT_TRUE(driven.arrived_s) << heading_rad << ": stands at " << driven.end.x_m << ", " << driven.end.y_m << ", "
                                  << driven.end.theta_rad;
    EXPECT_GT(driven.least_clearance_m, 0.02) << heading_rad;
    EXPECT_LE(driven.changes, 6) << heading_rad;
  }
}

TEST(ALongBody, GetsOutOfTheDoorAgainWhereItHasComeInAskew) {
  struct Start {
    Pose2 pose;
    Eigen::Vector2d goal_m;
  };
  // Drawn at random; each of them once stood in the door, or with a corner of its front before a jamb, and stayed.
  const std::vector<Start> starts = {
      {{2.58, 0.24, -0.76}, {1.21, 1.68}},
      {{1.88, 0.22, 3.01}, {1.63, 3.25}},
      {{1.86, 2.11, 2.02}, {-1.01, -0.15}},
      {{1.49, 1.68, -0.10}, {2.45, 0.33}},
  };
  for (const Start& start : starts) {
    const Drive driven = drive(chair(), corridor_with_door(), start.pose, start.goal_m, 90.0);
    EXPECT_TRUE(driven.arrived_s) << "stands at " << driven.end.x_m << ", " << driven.end.y_m << ", "
                                  << driven.end.theta_rad;
    EXPECT_GT(driven.least_clearance_m, 0.02);
  }
}

TEST(ALongBody, ReversesOutOfADeadEnd) {
  Points points;  // too narrow to turn round in: 1 m wide, closed ahead; the goal lies behind and aside
  add_wall(points, {-0.6, -0.5}, {1.3, -0.5});
  add_wall(points, {-0.6, 0.5}, {1.3, 0.5});
  add_wall(points, {1.3, -0.5}, {1.3, 0.5});
  const Drive driven = drive(chair(), points, {0.0, 0.0, 0.0}, {-1.8, 1.5});
  EXPECT_TRUE(driven.arrived_s);
  EXPECT_GT(driven.reversed_m, 0.3);
  EXPECT_GT(driven.least_clearance_m, 0.03);
}

TEST(ALongBody, StandsWhereItIsWalledIn) {
  Points points;
  add_wall(points, {-0.35, -0.42}, {0.95, -0.42});
  add_wall(points, {-0.35, 0.42}, {0.95, 0.42});
  add_wall(points, {-0.35, -0.42}, {-0.35, 0.42});
  add_wall(points, {0.95, -0.42}, {0.95, 0.42});
  const Drive driven = drive(chair(), points, {0.0, 0.0, 0.0}, {2.0, 0.0}, 10.0);
  EXPECT_FALSE(driven.arrived_s);
  EXPECT_GT(driven.least_clearance_m, 0.02);
}

TEST(ALongBody, TurnsRoundInACorridorForWhatLiesBehind) {
  Points points;  // 2.2 m wide: it can turn in the middle
  add_wall(points, {-3.0, -1.1}, {3.0, -1.1});
  add_wall(points, {-3.0, 1.1}, {3.0, 1.1});
  const Drive driven = drive(chair(), points, {0.0, 0.3, 0.0}, {-2.5, 0.0});
  EXPECT_TRUE(driven.arrived_s);
  EXPECT_GT(driven.least_clearance_m, 0.03);
}

TEST(ALongBody, LeavesAWallItStandsBeside) {
  for (const double room_m : {0.04, 0.06}) {
    Points points;
    add_wall(points, {-2.5, 0.325 + room_m}, {2.5, 0.325 + room_m});
    const Drive driven = drive(chair(), points, {0.0, 0.0, 0.0}, {1.5, -1.5});
    EXPECT_TRUE(driven.arrived_s) << room_m;
    EXPECT_GT(driven.least_clearance_m, room_m - 0.015) << room_m;
  }
}

TEST(LongWay, SearchesLittleWhereTheWayIsOpen) {
  const Points world = corridor_with_door();
  std::mt19937_64 random(1);
  const auto way_from = [&](const Pose2& at, const Eigen::Vector2d& goal_m) {
    const Pose2 to = inverse(at) * Pose2{goal_m.x(), goal_m.y(), 0.0};
    return long_way(chair().outline, swept(world, at, random), {to.x_m, to.y_m}, at.theta_rad);
  };
  const auto along_corridor = way_from({-1.0, 0.0, 0.0}, {1.0, 0.0});
  ASSERT_TRUE(along_corridor);
  EXPECT_TRUE(along_corridor->reaches_goal);
  EXPECT_LT(along_corridor->expanded, 100);
  const auto through_door = way_from({2.0, 0.0, 0.5 * kPi}, {2.0, 2.0});
  ASSERT_TRUE(through_door);
  EXPECT_TRUE(through_door->reaches_goal);
  EXPECT_LT(through_door->expanded, 200);
  const auto round_corner = way_from({0.0, 0.0, 0.0}, {2.0, 2.5});
  ASSERT_TRUE(round_corner);
  EXPECT_TRUE(round_corner->reaches_goal);
}

TEST(LongPlan, IsKeptWhereAnotherWayIsAboutAsGood) {
  // A post straight ahead in the open: left and right cost the same but for the noise of the sweeps.
  Points points;
  add_wall(points, {1.7, -0.1}, {1.7, 0.1});
  std::mt19937_64 random(3);
  LongPlan plan;
  const Pose2 start;
  steer_round(plan, chair(), swept(points, start, random), {2.3, 0.0}, start, 0.45, 1.8);
  ASSERT_GT(plan.poses.size(), 3U);
  const auto side = [&] {
    const auto farthest =
        std::ranges::max_element(plan.poses, {}, [](const WayPose& pose) { return std::abs(pose.pose.y_m); });
    return std::signbit(farthest->pose.y_m);
  };
  const bool first = side();
  for (int call = 0; call < 14; ++call) {
    steer_round(plan, chair(), swept(points, start, random), {2.3, 0.01 * (call % 3 - 1)}, start, 0.45, 1.8);
    EXPECT_EQ(side(), first) << call;
  }
}

TEST(LongPlan, IsGivenUpWhenSomethingStandsInIt) {
  LongPlan plan;
  const Pose2 start;
  steer_round(plan, chair(), {}, {2.3, 0.0}, start, 0.45, 1.8);
  ASSERT_FALSE(plan.poses.empty());
  EXPECT_LT(std::abs(plan.poses[plan.poses.size() / 2].pose.y_m), 0.05);
  Points post;
  add_wall(post, {1.7, -0.3}, {1.7, 0.3});
  std::mt19937_64 random(3);
  steer_round(plan, chair(), swept(post, start, random), {2.3, 0.0}, start, 0.45, 1.8);
  double aside_m = 0.0;
  for (const WayPose& pose : plan.poses) aside_m = std::max(aside_m, std::abs(pose.pose.y_m));
  EXPECT_GT(aside_m, 0.3);
}

}  // namespace
}  // namespace homeward::driving::lattice_test
