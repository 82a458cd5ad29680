// SPDX-License-Identifier: Apache-2.0
#include "exploration/picture_rows.hpp"

#include <gtest/gtest.h>

namespace homeward::exploration {
namespace {

const Pose2 kPose{1.5, -0.25, 0.5};

TEST(PictureRows, APictureThatNoLoopCameOfIsNew) {
  const auto rows = picture_rows({{30, 4, 0.8, false}}, {{30, 4, 0.8, false}}, 31, kPose);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].state, SurveyState::kNew);
  EXPECT_EQ(rows[0].picture, 31);
  EXPECT_EQ(rows[0].floor_from_robot.theta_rad, kPose.theta_rad);
  EXPECT_FALSE(rows[0].known || rows[0].agreement);
}

TEST(PictureRows, ALoopTellsWhichPictureItIsKnownBy) {
  const auto rows = picture_rows({{30, 4, 0.8, false}}, {{30, 4, 0.8, false}, {31, 5, 0.7, false}}, 31, kPose);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].state, SurveyState::kKnownAgain);
  EXPECT_EQ(rows[0].picture, 31);
  EXPECT_EQ(rows[0].known, 5);
  EXPECT_EQ(rows[0].agreement, 0.7);
}

TEST(PictureRows, LoopsThatAreTakenBackAreToldOnceAndAfterThePictureThatShowedThem) {
  const std::vector<KnownAgain> before = {{30, 4, 0.8, true}, {31, 5, 0.7, false}, {40, 6, 0.9, false}};
  const std::vector<KnownAgain> now = {
      {30, 4, 0.8, true}, {31, 5, 0.7, true}, {40, 6, 0.9, false}, {50, 7, 0.65, true}};
  const auto rows = picture_rows(before, now, 50, kPose);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].state, SurveyState::kKnownAgain);
  EXPECT_EQ(rows[0].picture, 50);
  EXPECT_EQ(rows[1].state, SurveyState::kTakenBack);
  EXPECT_EQ(rows[1].picture, 31);
  EXPECT_EQ(rows[1].known, 5);
  EXPECT_EQ(rows[2].state, SurveyState::kTakenBack);
  EXPECT_EQ(rows[2].picture, 50);
  EXPECT_EQ(rows[2].known, 7);
}

}  // namespace
}  // namespace homeward::exploration
