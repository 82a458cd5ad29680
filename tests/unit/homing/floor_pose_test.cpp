// SPDX-License-Identifier: Apache-2.0
#include "homing/floor_pose.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/angles.hpp"
#include "support/feature_cloud.hpp"

namespace homeward::homing::floor_pose_test {
namespace {

using testing::bearing_of;
using testing::cloud;

std::vector<PointSighting> seen_from(const Pose2& pose, int count, double noise_rad, int wrong, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto points = cloud(count, random);
  std::vector<PointSighting> sightings;
  for (const Eigen::Vector3d& point : points) {
    sightings.push_back({point, testing::shaken(bearing_of(pose, point), noise_rad, random)});
  }
  for (int i = 0; i < wrong; ++i) sightings[static_cast<std::size_t>(i)].here = testing::any_bearing(random);
  return sightings;
}

TEST(FloorPose, FindsThePoseAmongManyWrongSightings) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Pose2 truth{0.8, -1.1, 2.0};
    const auto pose = floor_pose(seen_from(truth, 60, 0.003, 24, seed), std::nullopt, {}, seed);
    ASSERT_TRUE(pose);
    EXPECT_LT(std::hypot(pose->map_from_robot.x_m - truth.x_m, pose->map_from_robot.y_m - truth.y_m), 0.02);
    EXPECT_LT(std::abs(wrap_angle(pose->map_from_robot.theta_rad - truth.theta_rad)), 0.005);
    EXPECT_GE(pose->inliers.size(), 34U);
  }
}

TEST(FloorPose, AWrongExpectationIsGivenUp) {
  const Pose2 truth{0.8, -1.1, 2.0};
  const auto pose = floor_pose(seen_from(truth, 60, 0.003, 10, 3), Pose2{-2.0, 2.0, -1.0}, {}, 1);
  ASSERT_TRUE(pose);
  EXPECT_LT(std::hypot(pose->map_from_robot.x_m - truth.x_m, pose->map_from_robot.y_m - truth.y_m), 0.02);
}

TEST(FloorPose, StatesItsErrorAboutRight) {
  const Pose2 truth{0.4, 0.3, -1.0};
  double squared = 0.0;
  double stated = 0.0;
  constexpr int kTrials = 100;
  for (std::uint64_t seed = 1; seed <= kTrials; ++seed) {
    const auto pose = floor_pose(seen_from(truth, 40, 0.005, 0, seed), truth, {}, seed);
    ASSERT_TRUE(pose);
    squared += std::pow(pose->map_from_robot.x_m - truth.x_m, 2) + std::pow(pose->map_from_robot.y_m - truth.y_m, 2);
    stated += pose->covariance(0, 0) + pose->covariance(1, 1);
  }
  EXPECT_GT(stated, 0.4 * squared);
  EXPECT_LT(stated, 2.5 * squared);
}

TEST(FloorPose, NothingAgreesOnNoise) {
  std::mt19937_64 random(5);
  std::vector<PointSighting> sightings;
  for (const Eigen::Vector3d& point : cloud(40, random)) sightings.push_back({point, testing::any_bearing(random)});
  const auto pose = floor_pose(sightings, std::nullopt, {}, 1);
  EXPECT_LT(pose ? pose->inliers.size() : 0U, 8U);
}

TEST(FloorPose, SameSeedSamePose) {
  const auto sightings = seen_from({0.8, -1.1, 2.0}, 60, 0.003, 24, 1);
  const auto first = floor_pose(sightings, std::nullopt, {}, 7);
  const auto second = floor_pose(sightings, std::nullopt, {}, 7);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->map_from_robot.x_m, second->map_from_robot.x_m);
  EXPECT_EQ(first->inliers, second->inliers);
}

TEST(FloorPose, TwoSightingsAreTooFew) {
  EXPECT_FALSE(floor_pose(seen_from({}, 2, 0.0, 0, 1), std::nullopt, {}, 1));
  EXPECT_FALSE(floor_pose({}, std::nullopt, {}, 1));
}

}  // namespace
}  // namespace homeward::homing::floor_pose_test
