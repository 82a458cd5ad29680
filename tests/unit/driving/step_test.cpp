// SPDX-License-Identifier: Apache-2.0
#include "driving/step.hpp"

#include <gtest/gtest.h>

#include "unit/driving/step_fixture.hpp"

namespace homeward::driving::step_test {
namespace {

using wire::ReasonCode;

using wire::DriveState;

TEST_F(StepTest, StandsWithoutAMission) {
  for (int k = 0; k < 20; ++k) EXPECT_TRUE(stands(tick({permit("m1", 1, k + 1)})));
  EXPECT_EQ(state_.drive, DriveState::kIdle);
}

TEST_F(StepTest, DrivesAMissionToItsEnd) {
  set_off();
  for (int k = 0; k < 400 && state_.drive == DriveState::kDriving; ++k) {
    const Outputs outputs = tick({permit("m1", 1, ++seq_)});
    EXPECT_LE(outputs.motion.speed_mps, 0.5);
  }
  EXPECT_EQ(state_.drive, DriveState::kArrived) << state_.reason;
  EXPECT_LT(std::hypot(pose_.x_m - 2.4, pose_.y_m), 0.2);
  expect_stays();
}

TEST_F(StepTest, TakesTheHeadingOfTheDestinationWhenItDocks) {
  wire::MissionOrder order = mission("m1", 1, 1);
  order.dock = true;
  order.final_appearance = wire::encode_appearance(seen_from(landmarks_, {2.4, 0.0, 1.2}, 7));
  tick({order});
  for (int k = 0; k < 600 && state_.drive != DriveState::kArrived; ++k) tick({permit("m1", 1, ++seq_)});
  ASSERT_EQ(state_.drive, DriveState::kArrived) << state_.reason;
  EXPECT_LT(std::abs(wrap_angle(pose_.theta_rad - 1.2)), 0.12);
}

TEST_F(StepTest, ALoopThatWasHeldUpStops) {
  set_off();
  now_ms_ += config_.loop_silence_ms;  // and the usual step on top of it
  EXPECT_TRUE(stands(tick({permit("m1", 1, ++seq_)})));
  EXPECT_EQ(state_.drive, DriveState::kStopped);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kComputerHeldUp});
  expect_stays();
  set_off(1, seq_ + 1);
}

TEST_F(StepTest, AStepThatComesJustInTimeDrivesOn) {
  set_off();
  now_ms_ += config_.loop_silence_ms - kTick_ms;
  tick({permit("m1", 1, ++seq_)});
  EXPECT_EQ(state_.drive, DriveState::kDriving) << state_.reason;
}

TEST_F(StepTest, ACoveredCameraStandsAndGivesUpAfterAWhile) {
  set_off();
  covered_ = true;
  EXPECT_TRUE(stands(tick({permit("m1", 1, ++seq_)})));  // at once
  EXPECT_EQ(state_.drive, DriveState::kDriving);
  const Milliseconds after_ms = until_stopped(true, 10'000);
  EXPECT_GT(after_ms, 0);
  EXPECT_LE(after_ms, config_.blind_ms + 2 * kTick_ms);
  EXPECT_EQ(state_.drive, DriveState::kFailed);
  expect_stays();
}

TEST_F(StepTest, ACameraUncoveredInTimeDrivesOn) {
  set_off();
  covered_ = true;
  for (int k = 0; k < 10; ++k) EXPECT_TRUE(stands(tick({permit("m1", 1, ++seq_)})));
  covered_ = false;
  double speed_mps = 0.0;
  for (int k = 0; k < 4; ++k) speed_mps = tick({permit("m1", 1, ++seq_)}).motion.speed_mps;
  EXPECT_GT(speed_mps, 0.05);
}

TEST_F(StepTest, IsTheSameForTheSameInputs) {
  set_off();
  DrivingState copy = state_;
  Inputs inputs;
  inputs.link_up = true;
  inputs.odometry = pose_;
  inputs.picture =
      SeenPicture{now_ms_, std::make_shared<const features::Appearance>(seen_from(landmarks_, pose_, 5)), {}, pose_};
  const Outputs one = step(state_, inputs, config_, now_ms_ + 10);
  const Outputs two = step(copy, inputs, config_, now_ms_ + 10);
  EXPECT_EQ(one.motion.speed_mps, two.motion.speed_mps);
  EXPECT_EQ(one.motion.turn_radps, two.motion.turn_radps);
}

}  // namespace
}  // namespace homeward::driving::step_test
