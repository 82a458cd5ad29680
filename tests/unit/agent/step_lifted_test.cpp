// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "agent/driving/step.hpp"
#include "unit/agent/step_fixture.hpp"

namespace homeward::agent {
namespace {

using wire::DriveState;

/// The same house, but for a part of its things.
homeward::testing::Landmarks twin_of(const homeward::testing::Landmarks& house, double other_share,
                                     const std::vector<Pose2>& way) {
  homeward::testing::Landmarks twin = house;
  const auto count = static_cast<int>(house.points_m.size());
  const homeward::testing::Landmarks others = homeward::testing::landmarks_around(way, count, 99);
  for (int i = 0; i < static_cast<int>(other_share * count); ++i) {
    twin.points_m[static_cast<std::size_t>(i)] = others.points_m[static_cast<std::size_t>(i)];
    twin.descriptors.row(i) = others.descriptors.row(i);
  }
  return twin;
}

TEST_F(StepTest, LiftedToAPlaceThatLooksAlikeItGivesUpAndSaysWhy) {
  landmarks_ = homeward::testing::landmarks_around(views(), 400, 3);
  set_off();
  tick({permit("m1", 1, ++seq_)});
  landmarks_ = twin_of(landmarks_, 0.65, views());
  const Milliseconds gone_ms = until_stopped(true, 2000);
  EXPECT_EQ(state_.drive, DriveState::kFailed);
  EXPECT_NE(state_.reason.find("lifted"), std::string::npos) << state_.reason;
  EXPECT_LT(gone_ms, 500);
  EXPECT_EQ(state_.displaced, 1);
  EXPECT_TRUE(state_.follow.hypotheses.empty());
}

TEST_F(StepTest, WhoeverStandsBeforeTheCameraHasNotLiftedIt) {
  landmarks_ = homeward::testing::landmarks_around(views(), 400, 3);
  set_off();
  hidden_ = true;
  for (int k = 0; k < 10; ++k) tick({permit("m1", 1, ++seq_)});
  hidden_ = false;
  until_stopped(true, 30'000);
  EXPECT_EQ(state_.drive, DriveState::kArrived) << state_.reason;
  EXPECT_EQ(state_.displaced, 0);
}

}  // namespace
}  // namespace homeward::agent
