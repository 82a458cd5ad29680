// SPDX-License-Identifier: Apache-2.0
#include "homing/home_vector.hpp"

#include <gtest/gtest.h>

#include "features/extract.hpp"
#include "support/painted_room.hpp"
#include "support/sample_map.hpp"

namespace homeward::homing::home_vector_test {
namespace {

features::Appearance seen_from(const Pose2& pose) {
  return features::extract(homeward::testing::painted_panorama({}, pose), {});
}

double off_deg(double angle_rad, double truth_rad) { return std::abs(degrees(wrap_angle(angle_rad - truth_rad))); }

TEST(HomeVector, PointsAtTheTargetFromAllSides) {
  const Pose2 home{0.3, 0.2, 0.5};
  const features::Appearance target = seen_from(home);
  for (const Pose2& now : {Pose2{-0.7, 0.2, 0.5}, Pose2{1.1, 0.9, -2.0}, Pose2{0.3, -0.6, 3.0}, Pose2{0.0, 1.0, 1.2}}) {
    const auto vector = home_vector(seen_from(now), target, {}, 1);
    ASSERT_TRUE(vector) << vector.error().message;
    const Pose2 now_from_home = inverse(now) * home;
    EXPECT_LT(off_deg(vector->bearing_rad, std::atan2(now_from_home.y_m, now_from_home.x_m)), 3.0);
    EXPECT_LT(off_deg(vector->turn_rad, now_from_home.theta_rad), 1.5);
    EXPECT_GT(vector->confidence, 0.8);
    EXPECT_GE(vector->inliers, 12);
    EXPECT_GE(vector->matches, vector->inliers);
    EXPECT_GT(vector->median_parallax_rad, HomingConfig{}.arrived_parallax_rad);
    EXPECT_FALSE(vector->nearness.has_value());  // no baseline is known from two pictures
  }
}

TEST(HomeVector, AheadIsAheadAndLeftIsLeft) {
  const features::Appearance here = seen_from({0.0, 0.0, 0.0});
  EXPECT_LT(off_deg(home_vector(here, seen_from({0.8, 0.0, 0.0}), {}, 1)->bearing_rad, 0.0), 3.0);
  EXPECT_LT(off_deg(home_vector(here, seen_from({0.0, 0.8, 0.0}), {}, 1)->bearing_rad, kPi / 2.0), 3.0);
  EXPECT_LT(off_deg(home_vector(here, seen_from({-0.8, 0.0, 0.0}), {}, 1)->bearing_rad, kPi), 3.0);
}

TEST(HomeVector, ParallaxFallsOnTheWayHome) {
  const features::Appearance target = seen_from({0.5, 0.0, 0.0});
  double before_rad = 10.0;
  for (const double x_m : {-0.7, 0.0, 0.35}) {
    const auto vector = home_vector(seen_from({x_m, 0.0, 0.1}), target, {}, 1);
    ASSERT_TRUE(vector);
    EXPECT_LT(vector->median_parallax_rad, before_rad);
    before_rad = vector->median_parallax_rad;
  }
}

TEST(HomeVector, SaysArrivedAtTheTarget) {
  const features::Appearance target = seen_from({0.5, 0.0, 0.0});
  const auto turned = home_vector(seen_from({0.51, 0.0, 0.8}), target, {}, 1);
  ASSERT_TRUE(turned);
  EXPECT_LT(turned->median_parallax_rad, HomingConfig{}.arrived_parallax_rad);
  EXPECT_LT(off_deg(turned->turn_rad, -0.8), 1.0);
  const auto same = home_vector(target, target, {}, 1);
  ASSERT_TRUE(same) << same.error().message;
  EXPECT_LT(same->median_parallax_rad, 1e-3);
  EXPECT_LT(off_deg(same->turn_rad, 0.0), 0.1);
}

TEST(HomeVector, NeverGuesses) {
  homeward::testing::PaintedRoom elsewhere;
  elsewhere.seed = 9;
  const features::Appearance here = seen_from({0.0, 0.0, 0.0});
  const auto foreign =
      home_vector(here, features::extract(homeward::testing::painted_panorama(elsewhere, {}), {}), {}, 1);
  ASSERT_FALSE(foreign);
  EXPECT_EQ(foreign.error().code, ErrorCode::kTooLittleSupport);
  const auto covered = home_vector(here, {}, {}, 1);
  ASSERT_FALSE(covered);
  EXPECT_EQ(covered.error().code, ErrorCode::kTooFewFeatures);
}

TEST(HomeVector, AsksForAsManyInliersAsConfigured) {
  const features::Appearance here = seen_from({0.0, 0.0, 0.0});
  const features::Appearance there = seen_from({0.8, 0.0, 0.0});
  HomingConfig config;
  config.min_inliers = home_vector(here, there, {}, 1)->inliers;
  EXPECT_TRUE(home_vector(here, there, config, 1));
  ++config.min_inliers;
  EXPECT_FALSE(home_vector(here, there, config, 1));
}

TEST(HomeVector, AnUncertainOneIsTheSameWhereOneIsSureAndAHintOfLittleConfidenceWhereNoneIs) {
  const features::Appearance here = seen_from({0.0, 0.0, 0.0});
  const features::Appearance there = seen_from({0.8, 0.3, 0.4});
  const auto sure = home_vector(here, there, {}, 1);
  const auto asked = uncertain_home_vector(here, there, 1);
  ASSERT_TRUE(sure && asked);
  EXPECT_EQ(asked->bearing_rad, sure->bearing_rad);
  EXPECT_EQ(asked->confidence, sure->confidence);
  homeward::testing::PaintedRoom elsewhere;
  elsewhere.seed = 9;
  const auto foreign =
      uncertain_home_vector(here, features::extract(homeward::testing::painted_panorama(elsewhere, {}), {}), 1);
  ASSERT_TRUE(foreign) << foreign.error().message;
  EXPECT_LE(foreign->confidence, 0.02);
  EXPECT_FALSE(uncertain_home_vector(here, {}, 1));
}

}  // namespace
}  // namespace homeward::homing::home_vector_test
