// SPDX-License-Identifier: Apache-2.0
#include "homing/scale_space.hpp"

#include <gtest/gtest.h>

#include "features/extract.hpp"
#include "support/painted_room.hpp"

namespace homeward::homing::scale_space_test {
namespace {

features::Appearance seen_from(const Pose2& pose) { return features::extract(testing::painted_panorama({}, pose), {}); }

double off_deg(double angle_rad, double truth_rad) { return std::abs(degrees(wrap_angle(angle_rad - truth_rad))); }

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
