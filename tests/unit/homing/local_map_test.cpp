// SPDX-License-Identifier: Apache-2.0
#include "homing/local_map.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/feature_cloud.hpp"

namespace homeward::homing::local_map_test {
namespace {

/// The target at the origin of a room of features.
struct Room {
  std::mt19937_64 random{1};
  std::vector<Eigen::Vector3d> points = testing::cloud(60, random);

  std::vector<Sighting> seen_from(const Pose2& pose, double noise_rad = 0.003) {
    std::vector<Sighting> sightings;
    for (std::size_t i = 0; i < points.size(); ++i) {
      sightings.push_back({static_cast<int>(i), points[i].normalized(),
                           testing::shaken(testing::bearing_of(pose, points[i]), noise_rad, random)});
    }
    return sightings;
  }
};

double apart_m(const Pose2& a, const Pose2& b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

/// The first guess has the right direction and half the distance.
FirstGuess half_as_far(const Pose2& truth) { return {{0.5 * truth.x_m, 0.5 * truth.y_m, truth.theta_rad}, 0.6}; }

TEST(LocalMap, OdometryGivesTheScale) {
  Room room;
  LocalMap map;
  const Pose2 start{-3.0, 0.5, 0.3};
  ASSERT_TRUE(map.begin(room.seen_from(start), Pose2{}, half_as_far(start)));
  EXPECT_EQ(map.features(), 60);
  for (double driven_m = 0.15; driven_m < 0.8; driven_m += 0.15) {
    const Pose2 odometry{driven_m, 0.0, 0.0};
    const Pose2 truth = start * odometry;
    const auto sightings = room.seen_from(truth);
    const auto pose = map.pose_of(sightings, map.expected(odometry), 1);
    ASSERT_TRUE(pose);
    ASSERT_TRUE(map.wants(pose->target_from_robot));
    ASSERT_TRUE(map.add(map.agreeing(sightings, pose->target_from_robot), odometry, pose->target_from_robot));
  }
  const Pose2 odometry{0.8, 0.1, 0.2};
  const auto pose = map.pose_of(room.seen_from(start * odometry), std::nullopt, 1);
  ASSERT_TRUE(pose);
  EXPECT_LT(apart_m(pose->target_from_robot, start * odometry), 0.1);
}

TEST(LocalMap, WithoutOdometryTheFirstBaselineIsTheUnit) {
  Room room;
  LocalMap map;
  const Pose2 start{-2.0, 0.0, 0.0};
  ASSERT_TRUE(map.begin(room.seen_from(start), std::nullopt, {{-1.0, 0.0, 0.0}, 0.05}));
  const auto halfway = map.pose_of(room.seen_from({-1.0, 0.0, 0.0}), std::nullopt, 1);
  ASSERT_TRUE(halfway);
  EXPECT_NEAR(halfway->target_from_robot.x_m, -0.5, 0.06);
  EXPECT_FALSE(map.expected(Pose2{}));
}

TEST(LocalMap, CloseToTheTargetItKnowsMillimetres) {
  Room room;
  LocalMap map;
  const Pose2 start{-2.0, 0.5, 0.0};
  ASSERT_TRUE(map.begin(room.seen_from(start), Pose2{}, half_as_far(start)));
  for (double driven_m = 0.2; driven_m < 1.9; driven_m += 0.2) {
    const Pose2 odometry{driven_m, -0.25 * driven_m, 0.0};
    const Pose2 truth = start * odometry;
    const auto sightings = room.seen_from(truth);
    const auto pose = map.pose_of(sightings, map.expected(odometry), 1);
    ASSERT_TRUE(pose);
    map.add(map.agreeing(sightings, pose->target_from_robot), odometry, pose->target_from_robot);
  }
  EXPECT_LE(map.keyframes(), LocalMapConfig{}.keyframes);
  const Pose2 near{-0.05, 0.02, 0.1};
  const auto pose = map.pose_of(room.seen_from(near), std::nullopt, 1);
  ASSERT_TRUE(pose);
  EXPECT_LT(apart_m(pose->target_from_robot, near), 0.008);
  EXPECT_LT(std::abs(pose->target_from_robot.theta_rad - near.theta_rad), 0.005);
}

TEST(LocalMap, APictureOfSomethingElseHasNoPose) {
  Room room;
  LocalMap map;
  ASSERT_TRUE(map.begin(room.seen_from({-2.0, 0.0, 0.0}), Pose2{}, {{-2.0, 0.0, 0.0}, 0.2}));
  std::vector<Sighting> wrong = room.seen_from({-2.0, 0.0, 0.0});
  for (Sighting& sighting : wrong) sighting.here = testing::any_bearing(room.random);
  EXPECT_FALSE(map.pose_of(wrong, Pose2{-2.0, 0.0, 0.0}, 1));
  EXPECT_FALSE(map.pose_of({}, std::nullopt, 1));
}

TEST(LocalMap, WhatDoesNotAgreeIsNotLearnt) {
  Room room;
  LocalMap map;
  const Pose2 start{-2.0, 0.0, 0.0};
  std::vector<Sighting> sightings = room.seen_from(start);
  const std::vector<Sighting> some(sightings.begin(), sightings.begin() + 40);
  const auto first = map.begin(some, Pose2{}, {start, 0.1});
  ASSERT_TRUE(first);
  // Of those that it knows one is wrong; of the new ones one cannot lie in front of both viewpoints.
  sightings[3].here = -sightings[3].here;
  sightings[50].here = -sightings[50].here;
  const auto agreeing = map.agreeing(sightings, first->target_from_robot);
  const auto has = [&](int feature) {
    return std::ranges::any_of(agreeing, [&](const Sighting& sighting) { return sighting.feature == feature; });
  };
  EXPECT_FALSE(has(3));
  EXPECT_FALSE(has(50));
  EXPECT_TRUE(has(4));
  EXPECT_GT(agreeing.size(), 45U);
}

TEST(LocalMap, BeingCarriedDoesNotSpoilIt) {
  Room room;
  LocalMap map;
  const Pose2 start{-2.0, 0.5, 0.0};
  ASSERT_TRUE(map.begin(room.seen_from(start), Pose2{}, half_as_far(start)));
  const auto drive = [&](const Pose2& truth, const Pose2& odometry) {
    const auto sightings = room.seen_from(truth);
    const auto pose = map.pose_of(sightings, std::nullopt, 1);
    ASSERT_TRUE(pose);
    ASSERT_TRUE(map.add(map.agreeing(sightings, pose->target_from_robot), odometry, pose->target_from_robot));
  };
  for (double x_m = 0.15; x_m < 0.9; x_m += 0.15) drive(start * Pose2{x_m, 0.0, 0.0}, {x_m, 0.0, 0.0});
  // Carried to the other side; the wheels did not turn.
  const Pose2 carried{1.0, -1.0, 2.0};
  drive(carried, {0.8, 0.0, 0.0});
  const auto pose = map.pose_of(room.seen_from({0.1, 0.0, 0.3}), std::nullopt, 1);
  ASSERT_TRUE(pose);
  EXPECT_LT(apart_m(pose->target_from_robot, {0.1, 0.0, 0.3}), 0.03);
}

TEST(LocalMap, StandingStillAsksForNoKeyframe) {
  Room room;
  LocalMap map;
  const Pose2 start{-2.0, 0.0, 0.0};
  EXPECT_TRUE(map.wants(start));
  const auto first = map.begin(room.seen_from(start), Pose2{}, {start, 0.1});
  ASSERT_TRUE(first);
  Pose2 turned = first->target_from_robot;
  turned.theta_rad += 1.0;
  EXPECT_FALSE(map.wants(turned));
  turned.x_m += 0.2;
  EXPECT_TRUE(map.wants(turned));
}

TEST(LocalMap, SameSightingsSameMap) {
  std::vector<double> results;
  for (int run = 0; run < 2; ++run) {
    Room room;
    LocalMap map;
    const Pose2 start{-2.0, 0.5, 0.0};
    ASSERT_TRUE(map.begin(room.seen_from(start), Pose2{}, half_as_far(start)));
    const auto pose = map.pose_of(room.seen_from({-1.5, 0.5, 0.0}), map.expected(Pose2{0.5, 0.0, 0.0}), 3);
    ASSERT_TRUE(pose);
    results.push_back(pose->target_from_robot.x_m);
  }
  EXPECT_EQ(results[0], results[1]);
}

}  // namespace
}  // namespace homeward::homing::local_map_test
