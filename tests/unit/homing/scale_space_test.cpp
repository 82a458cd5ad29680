// SPDX-License-Identifier: Apache-2.0
#include "homing/scale_space.hpp"

#include <gtest/gtest.h>

#include "features/extract.hpp"
#include "support/painted_room.hpp"

namespace homeward::homing::scale_space_test {
namespace {

features::Appearance seen_from(const Pose2& pose) { return features::extract(testing::painted_panorama({}, pose), {}); }

double off_deg(double angle_rad, double truth_rad) { return std::abs(degrees(wrap_angle(angle_rad - truth_rad))); }

TEST(ScaleSpaceDirection, WeighsMeanDirectionsByHowManyThereAre) {
  // Three contracted ones about straight ahead, 60 degrees apart: their mean is 0, the length of it 2/3. One expanded
  // one to the right: away from it is left.
  const double apart_rad = radians(60.0);
  const std::vector<ScaleChange> changes = {{-apart_rad, true}, {0.0, true}, {apart_rad, true}, {-kPi / 2.0, false}};
  // s = 3 sin 0 + 1 sin(-90 + 180), c = 3 cos 0 + 1 cos(-90 + 180).
  const auto by_groups = scale_space_direction(changes, ScaleSpaceSum::kGroupSizes);
  EXPECT_NEAR(by_groups.bearing_rad, std::atan2(1.0, 3.0), 1e-12);
  // Each for itself: the three come to no more than 2.
  const auto by_features = scale_space_direction(changes, ScaleSpaceSum::kEachFeature);
  EXPECT_NEAR(by_features.bearing_rad, std::atan2(1.0, 2.0), 1e-12);
  EXPECT_NEAR(by_features.agreement, std::sqrt(5.0) / 4.0, 1e-12);
  EXPECT_DOUBLE_EQ(by_groups.agreement, by_features.agreement);
}

TEST(ScaleSpaceDirection, IsThatOfOneGroupWhereTheOtherIsEmptyOrAllRound) {
  const std::vector<ScaleChange> contracted = {{0.4, true}, {0.6, true}};
  EXPECT_NEAR(scale_space_direction(contracted, ScaleSpaceSum::kGroupSizes).bearing_rad, 0.5, 1e-12);
  const std::vector<ScaleChange> expanded = {{0.4, false}, {0.6, false}};
  EXPECT_NEAR(scale_space_direction(expanded, ScaleSpaceSum::kGroupSizes).bearing_rad, 0.5 - kPi, 1e-12);
  const std::vector<ScaleChange> all_round = {{0.5, true}, {0.0, false}, {kPi, false}};
  EXPECT_NEAR(scale_space_direction(all_round, ScaleSpaceSum::kGroupSizes).bearing_rad, 0.5, 1e-12);
}

TEST(ScaleSpace, PointsRoughlyHomeByGroupsToo) {
  const Pose2 home{0.3, 0.2, 0.5};
  const features::Appearance target = seen_from(home);
  ScaleSpaceConfig config;
  config.sum = ScaleSpaceSum::kGroupSizes;
  for (const Pose2& now : {Pose2{-1.2, 0.2, 0.5}, Pose2{0.3, 1.6, 1.2}}) {
    const auto vector = scale_space_vector(seen_from(now), target, config);
    ASSERT_TRUE(vector) << vector.error().message;
    const Pose2 now_from_home = inverse(now) * home;
    EXPECT_LT(off_deg(vector->bearing_rad, std::atan2(now_from_home.y_m, now_from_home.x_m)), 45.0);
  }
}

TEST(ScaleSpace, PointsRoughlyHomeFromAllSides) {
  const Pose2 home{0.3, 0.2, 0.5};
  const features::Appearance target = seen_from(home);
  for (const Pose2& now : {Pose2{-1.2, 0.2, 0.5}, Pose2{1.6, 1.2, -2.0}, Pose2{0.3, -1.2, 3.0}, Pose2{0.3, 1.6, 1.2}}) {
    const auto vector = scale_space_vector(seen_from(now), target, {});
    ASSERT_TRUE(vector) << vector.error().message;
    const Pose2 now_from_home = inverse(now) * home;
    EXPECT_LT(off_deg(vector->bearing_rad, std::atan2(now_from_home.y_m, now_from_home.x_m)), 35.0);
    EXPECT_LT(off_deg(vector->turn_rad, now_from_home.theta_rad), 15.0);
    EXPECT_GT(vector->confidence, 0.0);
    EXPECT_LT(vector->confidence, 1.0);
    EXPECT_FALSE(vector->nearness);
  }
}

TEST(ScaleSpace, WhereNothingChangesItsSizeItSaysNothing) {
  const features::Appearance target = seen_from({0.3, 0.2, 0.5});
  const auto same = scale_space_vector(target, target, {});
  ASSERT_FALSE(same);
  EXPECT_EQ(same.error().code, ErrorCode::kTooLittleSupport);
}

TEST(ScaleSpace, AnEmptyPictureIsRefused) {
  const auto dark = scale_space_vector({}, seen_from({}), {});
  ASSERT_FALSE(dark);
  EXPECT_EQ(dark.error().code, ErrorCode::kTooFewFeatures);
}

}  // namespace
}  // namespace homeward::homing::scale_space_test
