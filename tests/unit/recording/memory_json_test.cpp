// SPDX-License-Identifier: Apache-2.0
#include "recording/memory_json.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace homeward::recording::memory_json_test {
namespace {

TEST(MemoryJson, KeepsWhatOutlivesTheBeginningOfAMission) {
  driving::DrivingState before;
  before.newest = {7, 12};
  before.least_epoch = 6;
  before.pictures = 1'000'000'000'000;
  before.covered = true;
  before.asking.number = 7;
  before.drive = wire::DriveState::kDriving;
  const auto read = memory_from_json(memory_to_json(before));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->newest, before.newest);
  EXPECT_EQ(read->least_epoch, 6);
  EXPECT_EQ(read->pictures, before.pictures);
  EXPECT_TRUE(read->covered);
  EXPECT_EQ(read->asking.number, 7) << "an answer names the question that was asked";
  EXPECT_EQ(read->drive, wire::DriveState::kIdle) << "there is no mission before the first step";
}

TEST(MemoryJson, KeepsTheWayBackAndTheMovingObstacleToTheLastBit) {
  constexpr float kNothing_m = std::numeric_limits<float>::infinity();
  driving::DrivingState before;
  before.refuses_until_ms = 4711;
  before.give_way.trail_m = {{0.1, 1.0 / 3.0}, {-2.0, 1e-17}};
  before.give_way.blocked_at_m = {1.1, -0.7};
  before.give_way.times = 2;
  before.moving_obstacle.before = driving::Scan{
      {0.1F, kNothing_m, std::numeric_limits<float>::quiet_NaN(), 3.3F}, -0.5, 0.1, 11.0, {0.2, -0.1, 3.0}};
  before.moving_obstacle.before_from = {1.0 / 7.0, 2.0, -3.0};
  before.moving_obstacle.before_ms = 123'456'789'012;
  before.moving_obstacle.seen_ms = 7;
  const auto read = memory_from_json(memory_to_json(before));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->refuses_until_ms, 4711);
  EXPECT_EQ(read->give_way.trail_m, before.give_way.trail_m);
  EXPECT_EQ(read->give_way.blocked_at_m, before.give_way.blocked_at_m);
  EXPECT_EQ(read->give_way.times, 2);
  const driving::Scan& scan = read->moving_obstacle.before.value();
  ASSERT_EQ(scan.ranges_m.size(), 4U);
  EXPECT_EQ(scan.ranges_m[0], 0.1F);
  EXPECT_EQ(scan.ranges_m[1], kNothing_m);
  EXPECT_TRUE(std::isnan(scan.ranges_m[2]));
  EXPECT_EQ(scan.ranges_m[3], 3.3F);
  EXPECT_EQ(scan.angle_min_rad, -0.5);
  EXPECT_EQ(scan.angle_step_rad, 0.1);
  EXPECT_EQ(scan.range_max_m, 11.0);
  EXPECT_EQ(scan.robot_from_scan.theta_rad, 3.0);
  EXPECT_EQ(read->moving_obstacle.before_from.x_m, 1.0 / 7.0);
  EXPECT_EQ(read->moving_obstacle.before_ms, 123'456'789'012);
  EXPECT_EQ(read->moving_obstacle.seen_ms, 7);
  for (const char* damaged : {R"({"give_way": {}})", R"({"stirring": 3})", R"({"give_way": {"trail_m": [[1]]}})"}) {
    EXPECT_FALSE(memory_from_json(damaged)) << damaged;
  }
}

TEST(MemoryJson, KeepsTheSweepThatTheNextOneGoesOnFromAndTheEstimateToTheLastBit) {
  driving::DrivingState before;
  before.going_on.before = driving::Scan{{1.5F, 2.5F}, 0.0, 0.1, 12.0, {}};
  before.going_on.odometry = {1.0 / 3.0, -2.0, 0.5};
  before.going_on.before_ms = 100;
  before.going_on.usual = 1.0 / 9.0;
  before.going_on.latest_ms = 300;
  before.going_on.broken_since_ms = 200;
  driving::PoseHypothesis one;
  one.map_from_robot = {1.0 / 7.0, 2.0, -3.0};
  one.covariance << 0.1, 0.01, 0.02, 0.01, 0.2, 0.03, 0.02, 0.03, 0.3;
  one.weight = 0.95;
  driving::PoseHypothesis other = one;
  other.weight = 0.04;
  before.kept =
      driving::KeptEstimate{MapId("m"), 4, driving::PoseHypotheses({}, {one, other}, 0.01, 0.2), {9.0, 8.0, 0.7}, 5000};
  const auto read = memory_from_json(memory_to_json(before));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->going_on.before.value().ranges_m, before.going_on.before->ranges_m);
  EXPECT_EQ(read->going_on.odometry.x_m, 1.0 / 3.0);
  EXPECT_EQ(read->going_on.before_ms, 100);
  EXPECT_EQ(read->going_on.usual, 1.0 / 9.0);
  EXPECT_EQ(read->going_on.latest_ms, 300);
  EXPECT_EQ(read->going_on.broken_since_ms, 200);
  ASSERT_TRUE(read->kept);
  EXPECT_EQ(read->kept->map, MapId("m"));
  EXPECT_EQ(read->kept->revision, 4);
  EXPECT_EQ(read->kept->at_ms, 5000);
  EXPECT_EQ(read->kept->odometry.theta_rad, 0.7);
  EXPECT_EQ(read->kept->hypotheses.elsewhere(), 0.01);
  EXPECT_EQ(read->kept->hypotheses.unweighed_m(), 0.2);
  ASSERT_EQ(read->kept->hypotheses.all().size(), 2U);
  EXPECT_EQ(read->kept->hypotheses.all()[0].map_from_robot.x_m, 1.0 / 7.0);
  EXPECT_EQ(read->kept->hypotheses.all()[0].covariance, one.covariance);
  EXPECT_EQ(read->kept->hypotheses.all()[1].weight, 0.04);
  EXPECT_FALSE(memory_from_json(R"({"kept_estimate": {"map": "m"}})"));
  EXPECT_FALSE(memory_from_json(R"({"going_on": {"before": 3}})"));
}

TEST(MemoryJson, OfNothingKeptNothingComesBack) {
  const auto read = memory_from_json(memory_to_json({}));
  ASSERT_TRUE(read);
  EXPECT_FALSE(read->kept);
  EXPECT_FALSE(read->going_on.before);
}

}  // namespace
}  // namespace homeward::recording::memory_json_test
