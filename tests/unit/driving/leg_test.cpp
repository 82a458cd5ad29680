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
    tick({explore("m1", {1, 1})});
    seq_ = 1;
  }
  static wire::ExploreOrder explore(const std::string& mission, const wire::Order& order) {
    return {MissionId(mission), order, 1500, 0.4, ExplorationId("x1"), false, {}, {}, {}};
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
  tick({wire::StopOrder{"s1", 1, std::nullopt, "test", 9}});
  tick({explore("m2", {1, 5})});
  EXPECT_NE(state_.drive, DriveState::kDriving);
  EXPECT_EQ(state_.mission->id, MissionId("m1"));
  tick({explore("m2", {1, 10})});
  EXPECT_EQ(state_.drive, DriveState::kDriving);
  EXPECT_EQ(state_.mission->id, MissionId("m2"));
}

TEST_F(LegTest, WhileTheRiderSteersAnOrderToExploreIsRefused) {
  hand_ = Motion{0.0, 0.5};
  const Outputs outputs = tick({explore("m2", {1, 5})});
  ASSERT_EQ(outputs.messages.size(), 1U);
  EXPECT_EQ(std::get<wire::MissionRefused>(outputs.messages[0]).reason, wire::Reason{ReasonCode::kRiderSteers});
  EXPECT_EQ(state_.mission->id, MissionId("m1"));
}

TEST_F(LegTest, ARobotThatDoesNotExploreRefusesAndSaysWhy) {
  why_not_exploring_ = wire::Reason{ReasonCode::kDoesNotExplore};
  const Outputs outputs = tick({explore("m2", {1, 5})});
  ASSERT_EQ(outputs.messages.size(), 1U);
  EXPECT_EQ(std::get<wire::MissionRefused>(outputs.messages[0]).mission, MissionId("m2"));
  EXPECT_EQ(std::get<wire::MissionRefused>(outputs.messages[0]).reason, wire::Reason{ReasonCode::kDoesNotExplore});
  EXPECT_EQ(state_.drive, DriveState::kStopped) << "nor does it go on with what it did before";
}

TEST_F(LegTest, AnExplorationThatIsOverHasArrivedAndOneThatDoesNotGetOnHasFailed) {
  leg_ = Leg{{3.0, 0.0}, 0.1};
  for (int k = 0; k < 10; ++k) on();
  over_ = ExplorationOver{false, wire::Reason{ReasonCode::kExplorationLimit}};
  EXPECT_TRUE(stands(on()));
  EXPECT_EQ(state_.drive, DriveState::kArrived);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kExplorationLimit});
  over_ = ExplorationOver{true, wire::Reason{ReasonCode::kExplorationStuck}};
  EXPECT_TRUE(stands(tick({explore("m2", {1, 1000})})));
  EXPECT_EQ(state_.drive, DriveState::kFailed);
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
