// SPDX-License-Identifier: Apache-2.0
#include "driving/steady_sweep.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/angles.hpp"

namespace homeward::driving::steady_sweep_test {
namespace {

constexpr int kRays = 360;

/// A scanner 0.2 m before the turning point of a robot that looks at a wall at x = wall_m.
Scan sweep_of_wall(const Pose2& robot, double wall_m, double noise_m, std::mt19937& random) {
  Scan scan;
  scan.angle_step_rad = 2.0 * kPi / kRays;
  scan.robot_from_scan = {0.2, 0.0, 0.0};
  const Pose2 scanner = robot * scan.robot_from_scan;
  std::normal_distribution<double> error_m(0.0, noise_m);
  for (int i = 0; i < kRays; ++i) {
    const double along = std::cos(scanner.theta_rad + i * scan.angle_step_rad);
    const double range_m = along > 0.1 ? (wall_m - scanner.x_m) / along : std::numeric_limits<double>::infinity();
    scan.ranges_m.push_back(static_cast<float>(noise_m > 0.0 ? range_m + error_m(random) : range_m));
  }
  return scan;
}

/// How far off the wall the points near its middle are, root mean square, in the frame of a robot at this pose.
double off_wall_m(const SteadySweep& sweeps, const Pose2& robot, double wall_m) {
  double sum = 0.0;
  int count = 0;
  for (const Eigen::Vector2d& point : sweeps.points_m()) {
    const double x_m = robot.x_m + std::cos(robot.theta_rad) * point.x() - std::sin(robot.theta_rad) * point.y();
    if (std::abs(point.y()) > 0.5) continue;
    sum += (x_m - wall_m) * (x_m - wall_m);
    ++count;
  }
  EXPECT_GT(count, 20);
  return std::sqrt(sum / count);
}

TEST(SteadySweep, OneSweepAloneIsAsItWasTaken) {
  std::mt19937 random(1);
  const Scan scan = sweep_of_wall({}, 1.0, 0.01, random);
  SteadySweep sweeps;
  sweeps.observe(scan, {}, 1000);
  const auto raw_m = hit_points(scan);
  ASSERT_EQ(sweeps.points_m().size(), raw_m.size());
  for (std::size_t i = 0; i < raw_m.size(); ++i) EXPECT_LT((sweeps.points_m()[i] - raw_m[i]).norm(), 1e-9);
}

TEST(SteadySweep, SixSweepsOfAWallHaveLessThanHalfTheNoiseOfOneWhileTheRobotDrivesAndTurns) {
  std::mt19937 random(2);
  SteadySweep sweeps;
  Pose2 robot;
  sweeps.observe(sweep_of_wall(robot, 1.0, 0.01, random), robot, 0);
  const double alone_m = off_wall_m(sweeps, robot, 1.0);
  for (int i = 1; i <= 5; ++i) {
    robot = robot * Pose2{0.02, 0.0, 0.03};
    sweeps.observe(sweep_of_wall(robot, 1.0, 0.01, random), robot, 100 * i);
  }
  EXPECT_GT(alone_m, 0.007);
  EXPECT_LT(off_wall_m(sweeps, robot, 1.0), 0.5 * alone_m);
}

TEST(SteadySweep, WhatComesNearerIsWhereTheNewestSweepShowsIt) {
  std::mt19937 random(3);
  SteadySweep sweeps;
  for (int i = 0; i <= 4; ++i) sweeps.observe(sweep_of_wall({}, 1.0 - 0.06 * i, 0.0, random), {}, 100 * i);
  EXPECT_LT(off_wall_m(sweeps, {}, 1.0 - 0.06 * 4), 1e-6);
}

TEST(SteadySweep, WhatWasSeenLongAgoIsForgotten) {
  std::mt19937 random(4);
  SteadySweep sweeps;
  sweeps.observe(sweep_of_wall({}, 1.02, 0.0, random), {}, 0);
  sweeps.observe(sweep_of_wall({}, 1.0, 0.0, random), {}, 400);
  EXPECT_GT(off_wall_m(sweeps, {}, 1.0), 0.005);
  sweeps.observe(sweep_of_wall({}, 1.0, 0.0, random), {}, 1000);
  EXPECT_LT(off_wall_m(sweeps, {}, 1.0), 1e-6);
}

TEST(SteadySweep, RaysThatSeeNothingStaySo) {
  Scan empty;
  empty.ranges_m.assign(kRays, std::numeric_limits<float>::infinity());
  empty.angle_step_rad = 2.0 * kPi / kRays;
  std::mt19937 random(5);
  SteadySweep sweeps;
  sweeps.observe(sweep_of_wall({}, 1.0, 0.0, random), {}, 0);
  sweeps.observe(empty, {}, 100);
  EXPECT_TRUE(sweeps.points_m().empty());
}

}  // namespace
}  // namespace homeward::driving::steady_sweep_test
