// SPDX-License-Identifier: Apache-2.0
#include "driving/leg.hpp"

#include <gtest/gtest.h>

#include "unit/driving/step_fixture.hpp"

namespace homeward::driving::leg_test {
namespace {

using wire::DriveState;
using wire::ReasonCode;

class LegTest : public StepTest {
 protected:
  void SetUp() override {
    Inputs inputs;
    inputs.odometry = pose_;
    begin_exploration(state_, {MissionId("m1"), {1, 1}, 1500, 0.4}, inputs, config_, now_ms_, now_ms_);
    seq_ = 1;
  }
  Outputs on() { return tick({permit("m1", 1, ++seq_)}); }
  [[nodiscard]] double off_m() const { return (position_m(pose_) - leg_->goal_m).norm(); }
};

TEST_F(LegTest, ItDrivesToTheLegsGoalAndStandsThere) {
  leg_ = Leg{{1.5, 0.8}, 0.1};
  for (int k = 0; k < 300; ++k) EXPECT_LE(on().motion.speed_mps, 0.4);
  EXPECT_LT(off_m(), 0.12);
  EXPECT_TRUE(stands(on()));
  EXPECT_EQ(state_.drive, DriveState::kDriving) << "it explores on";
  leg_ = Leg{{0.0, 0.0}, 0.1};
  for (int k = 0; k < 300; ++k) on();
  EXPECT_LT(off_m(), 0.12);
}

TEST_F(LegTest, WithoutALegItStands) {
  for (int k = 0; k < 20; ++k) EXPECT_TRUE(stands(on()));
  EXPECT_EQ(state_.drive, DriveState::kDriving);
}

TEST_F(LegTest, ALegThatAWallClosesIsBlockedAfterAWhileAndNothingIsTouched) {
  leg_ = Leg{{3.0, 0.0}, 0.1};
  for (int k = 0; k < 500 && !state_.leg.blocked; ++k) {
    see_wall_across(1.0);
    on();
  }
  EXPECT_TRUE(state_.leg.blocked);
  EXPECT_LT(pose_.x_m, 1.0 - config_.body.outline.radius_m);
  EXPECT_EQ(state_.drive, DriveState::kDriving) << "another leg may be free";
  leg_ = Leg{{-1.0, 0.0}, 0.1};
  see_wall_across(1.0);
  on();
  EXPECT_FALSE(state_.leg.blocked);
}

TEST_F(LegTest, GoalsThatChangeWithoutWayGainedAreBlockedToo) {
  ranges_m_.assign(ranges_m_.size(), 0.42F);  // walled in all round
  Milliseconds after_ms = 0;
  for (int k = 0; k < 500 && !state_.leg.blocked; ++k) {
    leg_ = Leg{{3.0, k % 2 == 0 ? 1.0 : -1.0}, 0.1};
    on();
    after_ms += kTick_ms;
  }
  EXPECT_TRUE(state_.leg.blocked);
  EXPECT_LE(after_ms, 20'000);
}

TEST_F(LegTest, TurningToAndFroAtOneSpotIsBlocked) {
  for (int k = 0; k < 1000 && !state_.leg.blocked; ++k) {
    leg_ = Leg{{k % 40 < 20 ? 0.25 : -0.25, 0.0}, 0.02};
    on();
  }
  EXPECT_TRUE(state_.leg.blocked);
}

TEST_F(LegTest, WhatStopsAMissionStopsAnExplorationToo) {
  leg_ = Leg{{3.0, 0.0}, 0.1};
  for (int k = 0; k < 10; ++k) on();
  const Milliseconds after_ms = until_stopped(false);
  EXPECT_GT(after_ms, 0) << "no permit comes any more";
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kPermitOver});
  EXPECT_TRUE(stands(on())) << "a permit does not begin it again";
}

TEST_F(LegTest, WithoutSweepsOrPicturesItStops) {
  leg_ = Leg{{3.0, 0.0}, 0.1};
  for (int k = 0; k < 10; ++k) on();
  sweeps_ = false;
  EXPECT_GT(until_stopped(true), 0);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kRangeSensorSilent});
}

TEST_F(LegTest, WithoutPicturesItStops) {
  leg_ = Leg{{3.0, 0.0}, 0.1};
  for (int k = 0; k < 10; ++k) on();
  pictures_ = false;
  EXPECT_GT(until_stopped(true), 0);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kCameraSilent});
}

TEST_F(LegTest, ItStandsUntilTheCameraShowsSomethingAndWhereThatIsNothing) {
  leg_ = Leg{{3.0, 0.0}, 0.1};
  pictures_ = false;
  for (int k = 0; k < 10; ++k) EXPECT_TRUE(stands(on()));
  pictures_ = true;
  for (int k = 0; k < 4; ++k) on();
  EXPECT_FALSE(stands(on()));
  covered_ = true;
  for (int k = 0; k < 3; ++k) on();
  EXPECT_TRUE(stands(on()));
}

TEST_F(LegTest, AStopOrderEndsItAndNoPermitBeginsItAgain) {
  leg_ = Leg{{3.0, 0.0}, 0.1};
  for (int k = 0; k < 10; ++k) on();
  EXPECT_TRUE(stands(tick({wire::StopOrder{"s1", 1, std::nullopt, "test"}})));
  EXPECT_EQ(state_.drive, DriveState::kStopped);
  for (int k = 0; k < 10; ++k) EXPECT_TRUE(stands(on()));
}

TEST_F(LegTest, WhatAStopHasOvertakenDoesNotBegin) {
  tick({wire::StopOrder{"s1", 9, std::nullopt, "test"}});
  Inputs inputs;
  inputs.odometry = pose_;
  EXPECT_FALSE(begin_exploration(state_, {MissionId("m2"), {1, 5}, 1500, 0.4}, inputs, config_, now_ms_, now_ms_));
  EXPECT_NE(state_.drive, DriveState::kDriving);
  inputs.rider = JoystickReading{now_ms_, true, {}};
  EXPECT_FALSE(begin_exploration(state_, {MissionId("m2"), {10, 1}, 1500, 0.4}, inputs, config_, now_ms_, now_ms_));
  inputs.rider.reset();
  EXPECT_TRUE(begin_exploration(state_, {MissionId("m2"), {10, 2}, 1500, 0.4}, inputs, config_, now_ms_, now_ms_));
}

TEST_F(LegTest, AnOrdinaryMissionDrivesAfterAnExploration) {
  leg_ = Leg{{-1.0, 0.0}, 0.1};
  for (int k = 0; k < 40; ++k) on();
  leg_.reset();
  pose_ = {};
  set_off(2, 1);
  for (int k = 0; k < 400 && state_.drive == DriveState::kDriving; ++k) tick({permit("m1", 2, ++seq_)});
  EXPECT_EQ(state_.drive, DriveState::kArrived) << state_.reason;
}

TEST_F(LegTest, TheRidersHandWins) {
  leg_ = Leg{{3.0, 0.0}, 0.1};
  for (int k = 0; k < 10; ++k) on();
  hand_ = Motion{0.0, 0.5};
  EXPECT_GT(on().motion.turn_radps, 0.0);
  EXPECT_EQ(state_.drive, DriveState::kStopped);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kRiderTookOver});
}

}  // namespace
}  // namespace homeward::driving::leg_test
