// SPDX-License-Identifier: Apache-2.0
#include "driving/estimate.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/driving/step_fixture.hpp"

namespace homeward::driving::estimate_test {
namespace {

using wire::DriveState;
using wire::ReasonCode;

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
  ticks_per_picture_ = 1;
  set_off();
  tick({permit("m1", 1, ++seq_)});
  landmarks_ = twin_of(landmarks_, 0.65, views());
  const Milliseconds gone_ms = until_stopped(true, 2000);
  EXPECT_EQ(state_.drive, DriveState::kFailed);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kLifted});
  EXPECT_LT(gone_ms, 500);
  EXPECT_EQ(state_.displaced, 1);
  EXPECT_TRUE(state_.follow.hypotheses.empty());
}

TEST_F(StepTest, LiftedToWhereAllLooksTheSameItsSweepsTellIt) {
  landmarks_ = homeward::testing::landmarks_around(views(), 400, 3);
  // Posts all round, as they are seen from where the robot is, and from half a metre further on.
  const auto see_posts = [&](double further_m) {
    ranges_m_.assign(360, kOpen_m);
    for (int post = 0; post < 12; ++post) {
      const double angle_rad = 2.0 * kPi * post / 12.0;
      const Pose2 at = inverse(pose_ * Pose2{further_m, 0.0, 0.0}) *
                       Pose2{1.2 + 4.0 * std::cos(angle_rad), 4.0 * std::sin(angle_rad), 0.0};
      const double azimuth_deg = std::atan2(at.y_m, at.x_m) * 180.0 / kPi;
      for (int beside = -3; beside <= 3; ++beside) {
        const auto ray = static_cast<std::size_t>((static_cast<int>(std::lround(azimuth_deg)) + beside + 720) % 360);
        ranges_m_[ray] = static_cast<float>(std::hypot(at.x_m, at.y_m));
      }
    }
  };
  see_posts(0.0);
  set_off();
  for (int k = 0; k < 12; ++k) {
    see_posts(0.0);
    tick({permit("m1", 1, ++seq_)});
  }
  ASSERT_EQ(state_.drive, DriveState::kDriving) << state_.reason;
  const Milliseconds from_ms = now_ms_;
  while (state_.drive == DriveState::kDriving && now_ms_ - from_ms < 2000) {
    see_posts(0.5);
    tick({permit("m1", 1, ++seq_)});
  }
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kLifted});
  EXPECT_LT(now_ms_ - from_ms, 1000);
  EXPECT_EQ(state_.displaced, 1);
  EXPECT_FALSE(state_.kept);
  const auto stand_for = [&](int ticks, double further_m) {
    for (int k = 0; k < ticks; ++k) {
      see_posts(further_m);
      tick();
    }
  };
  stand_for(20, 0.5);
  EXPECT_EQ(state_.displaced, 1);
  stand_for(20, 1.0);
  EXPECT_EQ(state_.displaced, 2) << "and between missions as well";
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
}  // namespace homeward::driving::estimate_test
