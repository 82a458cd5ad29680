// SPDX-License-Identifier: Apache-2.0
#include "driving/rider.hpp"

#include <gtest/gtest.h>

#include "unit/driving/step_fixture.hpp"

namespace homeward::driving::rider_test {
namespace {

using wire::DriveState;
using wire::ReasonCode;

class RiderTest : public StepTest {
 protected:
  /// Neither a server, nor a camera: what the rider needs all the same is nothing.
  void leave_alone() { link_up_ = server_talks_ = pictures_ = false; }
};

TEST_F(RiderTest, EndsAMissionInTheSameStepAndDrives) {
  set_off();
  hand_ = Motion{-0.1, 0.3};
  const Outputs outputs = tick({permit("m1", 1, ++seq_)});
  EXPECT_EQ(state_.drive, DriveState::kStopped);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kRiderTookOver});
  EXPECT_DOUBLE_EQ(outputs.motion.speed_mps, -0.1);
  EXPECT_DOUBLE_EQ(outputs.motion.turn_radps, 0.3);
}

TEST_F(RiderTest, AHandOnTheJoystickEndsWhatMightBeSentOnAfterAFailedDrive) {
  set_off();
  server_talks_ = true;
  belief_.place = PlaceId("p77");
  belief_.probability = 0.97;
  ASSERT_GE(until_stopped(true), 0);
  ASSERT_EQ(state_.drive, DriveState::kFailed) << state_.reason;
  hand_ = Motion{0.3, 0.0};
  tick();
  EXPECT_EQ(state_.drive, DriveState::kStopped);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kRiderTookOver});
}

TEST_F(RiderTest, ReleasedItStandsAndNothingMovesByItself) {
  set_off();
  hand_ = Motion{0.3, 0.0};
  for (int k = 0; k < 5; ++k) EXPECT_GT(tick({permit("m1", 1, ++seq_)}).motion.speed_mps, 0.2);
  hand_ = Motion{};
  EXPECT_TRUE(stands(tick({permit("m1", 1, ++seq_)})));
  expect_stays();
  set_off(1, seq_ + 1);  // only a newer mission moves it again
}

TEST_F(RiderTest, DrivesWithoutLinkMissionPermitAndPictures) {
  leave_alone();
  hand_ = Motion{0.4, -0.2};
  const Outputs outputs = tick();
  EXPECT_DOUBLE_EQ(outputs.motion.speed_mps, 0.4);
  EXPECT_DOUBLE_EQ(outputs.motion.turn_radps, -0.2);
  EXPECT_EQ(state_.drive, DriveState::kIdle);
}

TEST_F(RiderTest, AHandAtRestIsNone) {
  hand_ = Motion{};
  set_off();
  EXPECT_EQ(state_.drive, DriveState::kDriving);
}

TEST_F(RiderTest, AWordThatIsTooOldCountsAsReleased) {
  leave_alone();
  hand_ = Motion{0.4, 0.0};
  hand_age_ms_ = config_.rider_silence_ms;
  EXPECT_GT(tick().motion.speed_mps, 0.0);
  hand_age_ms_ = config_.rider_silence_ms + 1;
  EXPECT_TRUE(stands(tick()));
  hand_age_ms_ = -config_.rider_silence_ms - 1;
  EXPECT_TRUE(stands(tick())) << "a word of a time to come";
  hand_.reset();
  EXPECT_TRUE(stands(tick()));
}

TEST_F(RiderTest, TheBodyLimitsTheSpeed) {
  leave_alone();
  hand_ = Motion{9.0, -9.0};
  const Motion motion = tick().motion;
  EXPECT_DOUBLE_EQ(motion.speed_mps, config_.body.max_speed_mps);
  EXPECT_DOUBLE_EQ(motion.turn_radps, -config_.body.max_turn_radps);
  hand_ = Motion{std::numeric_limits<double>::quiet_NaN(), 0.0};
  EXPECT_TRUE(stands(tick()));
}

TEST_F(RiderTest, TheRangeSensorHasTheLastWord) {
  leave_alone();
  ranges_m_.assign(90, 0.4F);  // walled in all round
  hand_ = Motion{0.4, 0.0};
  EXPECT_DOUBLE_EQ(tick().motion.speed_mps, 0.0);
  hand_ = Motion{0.0, 0.4};
  EXPECT_DOUBLE_EQ(tick().motion.turn_radps, 0.4) << "turning on the spot touches nothing";
}

TEST_F(RiderTest, ALongBodyIsBentPastAPostOnlyOnceItTurns) {
  leave_alone();
  config_.body.outline = {0.0, 0.25, 0.85, 0.325};
  ranges_m_.assign(360, 20.0F);
  ranges_m_[20] = 0.963F;  // a post 5.5 cm before the left corner of its front
  hand_ = Motion{0.1, -0.3};
  tick();
  EXPECT_EQ(tick().motion.speed_mps, 0.0);
  pose_.theta_rad -= 0.04;  // turned by hand, 0.4 rad/s
  const Motion motion = tick().motion;
  EXPECT_GT(motion.speed_mps, 0.02) << state_.turning.radps();
}

TEST_F(RiderTest, WithoutAFreshSweepItCreeps) {
  leave_alone();
  sweeps_ = false;
  hand_ = Motion{0.8, 1.0};
  const Motion never = tick().motion;  // no sweep has ever come
  EXPECT_DOUBLE_EQ(never.speed_mps, 0.12);
  EXPECT_DOUBLE_EQ(never.turn_radps, 0.4);
  sweeps_ = true;
  EXPECT_GT(tick().motion.speed_mps, 0.5);
  sweeps_ = false;
  for (Milliseconds gone_ms = kTick_ms; gone_ms <= config_.scan_silence_ms; gone_ms += kTick_ms) tick();
  EXPECT_DOUBLE_EQ(tick().motion.speed_mps, 0.12);
}

TEST_F(RiderTest, AMissionIsRefusedWhileTheHandIsThere) {
  hand_ = Motion{0.2, 0.0};
  const Outputs outputs = tick({mission("m1", 1, 1)});
  EXPECT_EQ(state_.drive, DriveState::kIdle);
  ASSERT_EQ(outputs.messages.size(), 1U);
  ASSERT_TRUE(std::holds_alternative<wire::MissionRefused>(outputs.messages[0]));
  EXPECT_EQ(std::get<wire::MissionRefused>(outputs.messages[0]).reason, wire::Reason{ReasonCode::kRiderSteers});
  hand_ = Motion{};
  expect_stays();
  EXPECT_TRUE(stands(tick({mission("m1", 1, 1)}))) << "what was refused is not taken up later";
  EXPECT_EQ(state_.drive, DriveState::kIdle);
}

TEST_F(RiderTest, AStopFromTheHouseIsAnsweredAndTheRiderGoesOn) {
  hand_ = Motion{0.2, 0.0};
  const Outputs outputs = tick({wire::StopOrder{"s1", 1, std::nullopt, "anna"}});
  EXPECT_EQ(outputs.messages.size(), 1U);
  EXPECT_DOUBLE_EQ(outputs.motion.speed_mps, 0.2);
}

TEST_F(RiderTest, AHandThatTheBaseObeysByItselfEndsTheMissionAndMovesNothing) {
  set_off();
  Inputs inputs;
  inputs.link_up = true;
  inputs.odometry = pose_;
  inputs.rider = JoystickReading{now_ms_ + kTick_ms, true, {}};
  EXPECT_TRUE(stands(step(state_, inputs, config_, now_ms_ + kTick_ms)));
  EXPECT_EQ(state_.drive, DriveState::kStopped);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kRiderTookOver});
}

}  // namespace
}  // namespace homeward::driving::rider_test
