// SPDX-License-Identifier: Apache-2.0
#include "driving/orders.hpp"

#include <gtest/gtest.h>

#include "unit/driving/step_fixture.hpp"

namespace homeward::driving::orders_test {
namespace {

using wire::ReasonCode;

using wire::DriveState;

TEST_F(StepTest, WhatWasOrderedWhileTheProcessWasFrozenMovesNothing) {
  tick();
  now_ms_ += 10'000;
  // The order may be read from the socket some steps after waking.
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(stands(tick()));
  const Outputs outputs = tick({mission("m1", 1, 1)});
  EXPECT_TRUE(stands(outputs));
  EXPECT_EQ(state_.drive, DriveState::kIdle);
  ASSERT_EQ(outputs.messages.size(), 1U);
  ASSERT_TRUE(std::holds_alternative<wire::MissionRefused>(outputs.messages[0]));
  EXPECT_EQ(std::get<wire::MissionRefused>(outputs.messages[0]).reason, wire::Reason{ReasonCode::kWasHeldUp});
  expect_stays();
  set_off(1, seq_ + 1);  // that was two seconds later
}

TEST_F(StepTest, AStopIsAnsweredAndObeyedInTheSameStep) {
  set_off();
  const Outputs outputs = tick({wire::StopOrder{"s7", 1, std::nullopt, "anna"}});
  EXPECT_TRUE(stands(outputs));
  ASSERT_EQ(outputs.messages.size(), 1U);
  ASSERT_TRUE(std::holds_alternative<wire::Stopped>(outputs.messages[0]));
  EXPECT_EQ(std::get<wire::Stopped>(outputs.messages[0]).stop_id, "s7");
  EXPECT_EQ(state_.drive, DriveState::kStopped);
  EXPECT_EQ(state_.reason, (wire::Reason{ReasonCode::kStoppedBy, {{"by", "anna"}}}));
  expect_stays();
  EXPECT_TRUE(stands(tick({mission("m1", 1, 1)})));  // the mission of before the stop, once more
  EXPECT_EQ(state_.drive, DriveState::kStopped);
  set_off(1, seq_ + 1);  // a newer mission moves it again
}

TEST_F(StepTest, AStopOfAnOlderEpochStopsTooAndIsAnsweredWhileStanding) {
  set_off(4, 1);
  EXPECT_TRUE(stands(tick({wire::StopOrder{"s1", 2, wire::in_words("Enough."), "anna"}})));
  EXPECT_EQ(state_.reason, wire::in_words("Enough."));
  EXPECT_EQ(tick({wire::StopOrder{"s2", 4, std::nullopt, "bert"}}).messages.size(), 1U);
}

TEST_F(StepTest, AMissionThatAStopHasOvertakenMovesNothing) {
  tick({wire::StopOrder{"s1", 3, wire::in_words("Enough."), "anna", 7}});
  EXPECT_TRUE(stands(tick({mission("m1", 3, 6)})));
  EXPECT_TRUE(stands(tick({mission("m2", 2, 9)})));
  EXPECT_EQ(state_.drive, DriveState::kIdle);
  expect_stays();
  set_off(3, 8);
}

TEST_F(StepTest, OrdersOfAnOlderEpochOrNumberAreIgnored) {
  set_off(3, 10);
  tick({mission("older epoch", 2, 99), mission("older number", 3, 10)});
  ASSERT_TRUE(state_.mission);
  EXPECT_EQ(state_.mission->id.str(), "m1");
  // Permits that are old, repeated, of another mission or of another epoch renew nothing.
  const Milliseconds ends_ms = state_.permit_ends_ms;
  tick({permit("m1", 3, seq_), permit("m1", 2, 99), permit("m2", 3, seq_ + 1), permit("m1", 4, 1)});
  EXPECT_EQ(state_.permit_ends_ms, ends_ms);
  tick({permit("m1", 3, seq_ + 1)});
  EXPECT_GT(state_.permit_ends_ms, ends_ms);
}

TEST_F(StepTest, ANewConnectionStopsAndItsOlderMissionsMoveNothing) {
  set_off(1, 1);
  EXPECT_TRUE(stands(tick({wire::Welcome{"server", RobotId("r1"), 2, 200}})));
  EXPECT_EQ(state_.drive, DriveState::kStopped);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kLinkMadeAnew});
  expect_stays();
  EXPECT_TRUE(stands(tick({mission("m1", 1, seq_ + 100)})));
  EXPECT_EQ(state_.drive, DriveState::kStopped);
  set_off(2, 1);
}

TEST_F(StepTest, AWelcomeOfTheSameEpochChangesNothing) {
  set_off(2, 1);
  tick({wire::Welcome{"server", RobotId("r1"), 2, 200}});
  EXPECT_EQ(state_.drive, DriveState::kDriving);
}

TEST_F(StepTest, RefusesAMissionMadeWithOtherFeatures) {
  wire::MissionOrder order = mission("m9", 5, 6);
  order.feature_config_id = "hw1-other";
  const Outputs outputs = tick({order});
  EXPECT_TRUE(stands(outputs));
  ASSERT_EQ(outputs.messages.size(), 1U);
  ASSERT_TRUE(std::holds_alternative<wire::MissionRefused>(outputs.messages[0]));
  const auto& refused = std::get<wire::MissionRefused>(outputs.messages[0]);
  EXPECT_EQ(refused.mission.str(), "m9");
  EXPECT_EQ(refused.order, (wire::Order{5, 6}));
  EXPECT_EQ(refused.reason.code, ReasonCode::kFeaturesDiffer);
  EXPECT_EQ(state_.drive, DriveState::kIdle);
}

TEST_F(StepTest, RefusesAMissionWhoseViewsAreDamagedAndStopsTheOneUnderWay) {
  set_off();
  wire::MissionOrder order = mission("m2", 1, seq_ + 1);
  order.path[1].appearance.resize(40);
  const Outputs outputs = tick({order});
  EXPECT_TRUE(stands(outputs));
  ASSERT_EQ(outputs.messages.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<wire::MissionRefused>(outputs.messages[0]));
  EXPECT_EQ(state_.drive, DriveState::kStopped);
}

}  // namespace
}  // namespace homeward::driving::orders_test
