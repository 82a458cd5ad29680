// SPDX-License-Identifier: Apache-2.0
#include "driving/permitted.hpp"

#include <gtest/gtest.h>

#include "unit/driving/step_fixture.hpp"

namespace homeward::driving::permitted_test {
namespace {

using wire::ReasonCode;

using wire::DriveState;

TEST_F(StepTest, ALinkThatIsDownStopsAtOnce) {
  set_off();
  link_up_ = false;
  EXPECT_TRUE(stands(tick()));
  EXPECT_EQ(state_.drive, DriveState::kStopped);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kLinkLost});
  expect_stays();
}

TEST_F(StepTest, ASilentServerStopsWithinItsLimit) {
  set_off();
  server_talks_ = false;
  const Milliseconds after_ms = until_stopped(false);
  EXPECT_GE(after_ms, config_.link_silence_ms);
  EXPECT_LE(after_ms, config_.link_silence_ms + kTick_ms);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kServerSilent});
  expect_stays();
}

/// The fastest that the robot may still go `silence_ms` after the last word, to be at rest within the promised time.
double fastest_mps(const DrivingConfig& config, Milliseconds silence_ms) {
  const auto left_ms = static_cast<double>(config.stands_within_ms - config.reaction_ms - silence_ms);
  return config.body.deceleration_mps2 * std::max(0.0, 0.001 * left_ms);
}

TEST_F(StepTest, ASilentServerSlowsItSoThatItRestsHalfASecondAfterTheLastWord) {
  set_off();
  server_talks_ = false;
  for (Milliseconds silence_ms = kTick_ms; silence_ms <= 400; silence_ms += kTick_ms) {
    EXPECT_LE(tick().motion.speed_mps, fastest_mps(config_, silence_ms) + 1e-9) << silence_ms;
  }
  EXPECT_TRUE(stands(tick()));
}

TEST_F(StepTest, ASilentRangeSensorSlowsItSoThatItRestsHalfASecondAfterTheLastSweep) {
  set_off();
  sweeps_ = false;
  for (Milliseconds silence_ms = kTick_ms; silence_ms <= 400; silence_ms += kTick_ms) {
    const Outputs outputs = tick({permit("m1", 1, ++seq_)});
    EXPECT_LE(outputs.motion.speed_mps, fastest_mps(config_, silence_ms) + 1e-9) << silence_ms;
  }
  EXPECT_TRUE(stands(tick({permit("m1", 1, ++seq_)})));
}

TEST_F(StepTest, ASilentCameraSlowsItSoThatItRestsHalfASecondAfterTheLastPicture) {
  set_off();
  pictures_ = false;
  for (Milliseconds silence_ms = kTick_ms; silence_ms <= 400; silence_ms += kTick_ms) {
    const Outputs outputs = tick({permit("m1", 1, ++seq_)});
    EXPECT_LE(outputs.motion.speed_mps, fastest_mps(config_, silence_ms) + 1e-9) << silence_ms;
  }
  EXPECT_TRUE(stands(tick({permit("m1", 1, ++seq_)})));
  EXPECT_EQ(state_.drive, DriveState::kDriving) << "it waits for pictures, standing";
  pictures_ = true;
  double speed_mps = 0.0;
  for (int k = 0; k < 3; ++k) speed_mps = tick({permit("m1", 1, ++seq_)}).motion.speed_mps;
  EXPECT_GT(speed_mps, 0.05);
}

TEST_F(StepTest, PicturesThatAreLookedAtForLongSlowIt) {
  set_off();
  picture_age_ms_ = 400;
  for (int k = 0; k < 10; ++k) {
    EXPECT_LE(tick({permit("m1", 1, ++seq_)}).motion.speed_mps, fastest_mps(config_, 400 - config_.reaction_ms) + 1e-9);
  }
  EXPECT_EQ(state_.drive, DriveState::kDriving) << state_.reason;
}

TEST_F(StepTest, AShortSilenceSlowsItAndTheNextWordLetsItGoOn) {
  set_off();
  const double before_mps = tick({permit("m1", 1, ++seq_)}).motion.speed_mps;
  server_talks_ = false;
  for (int k = 0; k < 6; ++k) tick();
  EXPECT_LT(tick().motion.speed_mps, 0.11);
  server_talks_ = true;
  double after_mps = 0.0;
  for (int k = 0; k < 2; ++k) after_mps = tick({permit("m1", 1, ++seq_)}).motion.speed_mps;
  EXPECT_EQ(state_.drive, DriveState::kDriving);
  EXPECT_GT(after_mps, 0.5 * before_mps);
}

TEST_F(StepTest, APermitThatIsNotRenewedRunsOut) {
  set_off();  // the last permit came with the last tick
  const Milliseconds after_ms = until_stopped(false);
  EXPECT_GE(after_ms, 1500);
  EXPECT_LE(after_ms, 1500 + kTick_ms);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kPermitOver});
  expect_stays();
}

TEST_F(StepTest, ACameraThatFallsSilentStops) {
  set_off();
  pictures_ = false;
  const Milliseconds after_ms = until_stopped(true);
  EXPECT_GE(after_ms, config_.frame_silence_ms);
  EXPECT_LE(after_ms, config_.frame_silence_ms + kTick_ms);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kCameraSilent});
  expect_stays();
}

TEST_F(StepTest, PicturesThatComeTooLateAreAsGoodAsNone) {
  set_off();
  pictures_ = false;
  const auto old = std::make_shared<const features::Appearance>(seen_from(landmarks_, pose_, 1));
  Inputs inputs;
  inputs.link_up = true;
  inputs.odometry = pose_;
  inputs.messages = {permit("m1", 1, ++seq_)};
  inputs.scan = state_.scan;
  inputs.scan->taken_ms = now_ms_ + 10;
  inputs.picture = SeenPicture{now_ms_ - config_.frame_silence_ms, old, {}, pose_};
  EXPECT_TRUE(stands(step(state_, inputs, config_, now_ms_ + 10)));
  EXPECT_EQ(state_.drive, DriveState::kStopped);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kCameraSilent});
}

TEST_F(StepTest, AFirstPictureOfBeforeTheMissionIsNoReasonToStopNorToDrive) {
  picture_age_ms_ = 2 * config_.frame_silence_ms;
  tick({mission("m1", 1, 1)});
  for (int k = 0; k < 30; ++k) {
    EXPECT_TRUE(stands(tick({permit("m1", 1, ++seq_)})));
    ASSERT_EQ(state_.drive, DriveState::kDriving) << state_.reason << " after " << k * kTick_ms << " ms";
  }
  picture_age_ms_ = 0;
  double speed_mps = 0.0;
  for (int k = 0; k < 4; ++k) speed_mps = tick({permit("m1", 1, ++seq_)}).motion.speed_mps;
  EXPECT_GT(speed_mps, 0.05);
  // From now on old pictures are as good as none.
  picture_age_ms_ = config_.frame_silence_ms + kTick_ms;
  EXPECT_TRUE(stands(tick({permit("m1", 1, ++seq_)})));
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kCameraSilent});
}

TEST_F(StepTest, PicturesThatAreAlwaysTooOldEndTheMissionWhenTheFirstOneIsDue) {
  picture_age_ms_ = config_.frame_silence_ms + kTick_ms;
  tick({mission("m1", 1, 1)});
  const Milliseconds after_ms = until_stopped(true, 10'000);
  EXPECT_GE(after_ms, config_.first_frame_ms);
  EXPECT_LE(after_ms, config_.first_frame_ms + kTick_ms);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kCameraSilent});
  expect_stays();
}

TEST_F(StepTest, ClocksThatAreAheadHideNoSilence) {
  picture_age_ms_ = sweep_age_ms_ = -60'000;
  set_off();
  pictures_ = false;
  EXPECT_LE(until_stopped(true), config_.frame_silence_ms + kTick_ms);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kCameraSilent});
  pictures_ = true;
  set_off(1, seq_ + 1);
  sweeps_ = false;
  EXPECT_LE(until_stopped(true), config_.scan_silence_ms + kTick_ms);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kRangeSensorSilent});
}

TEST_F(StepTest, ARangeSensorThatFallsSilentStops) {
  set_off();
  sweeps_ = false;
  const Milliseconds after_ms = until_stopped(true);
  EXPECT_GE(after_ms, config_.scan_silence_ms);
  EXPECT_LE(after_ms, config_.scan_silence_ms + kTick_ms);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kRangeSensorSilent});
  expect_stays();
}

TEST_F(StepTest, ARobotThatIsNotReachedIsToldOfAsThat) {
  set_off();
  sweeps_ = robot_link_up_ = false;
  const Milliseconds after_ms = until_stopped(true);
  EXPECT_LE(after_ms, config_.scan_silence_ms + kTick_ms) << "as for any silence";
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kRobotLinkLost});
  expect_stays();
}

TEST_F(StepTest, ARobotThatIsNotReachedForAMomentDrivesOn) {
  set_off();
  robot_link_up_ = false;
  for (int k = 0; k < 30; ++k) tick({permit("m1", 1, ++seq_)});
  EXPECT_EQ(state_.drive, DriveState::kDriving) << "what is sensed comes all the same";
  pictures_ = false;
  EXPECT_LE(until_stopped(true), config_.frame_silence_ms + kTick_ms);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kRobotLinkLost});
}

TEST_F(StepTest, WithoutAnySweepItNeverSetsOff) {
  sweeps_ = false;
  EXPECT_TRUE(stands(tick({mission("m1", 1, 1)})));
  EXPECT_EQ(state_.drive, DriveState::kStopped);
}

TEST_F(StepTest, KeepsToTheLimitOfTheMissionToTheLastCentimetre) {
  wire::MissionOrder order = mission("m1", 1, 1);
  order.speed_limit_mps = 0.1;
  double fastest_mps = 0.0;
  for (int k = 0; k < 600 && (k == 0 || state_.drive == DriveState::kDriving); ++k) {
    std::vector<wire::ServerMessage> messages;
    if (k == 0) messages.emplace_back(order);
    messages.emplace_back(permit("m1", 1, ++seq_));
    fastest_mps = std::max(fastest_mps, std::abs(tick(std::move(messages)).motion.speed_mps));
  }
  EXPECT_EQ(state_.drive, DriveState::kArrived) << state_.reason;
  EXPECT_LE(fastest_mps, 0.1);
  EXPECT_GT(fastest_mps, 0.09);
}

TEST_F(StepTest, DrivesSlowlyWhereNoTourDrove) {
  const auto fastest_mps = [this](bool shortcut, int epoch) {
    pose_ = {};
    wire::MissionOrder order = mission("m1", epoch, 1);
    order.path[0].next->shortcut = shortcut;
    double fastest = 0.0;
    seq_ = 1;
    for (int k = 0; k < 600 && (k == 0 || state_.drive == DriveState::kDriving); ++k) {
      std::vector<wire::ServerMessage> messages;
      if (k == 0) messages.emplace_back(order);
      messages.emplace_back(permit("m1", epoch, ++seq_));
      const Outputs outputs = tick(std::move(messages));
      // The end of the shortcut counts as passed from half a metre off; no tour drove up to it all the same.
      const bool before_its_end = state_.follow.index >= 1 && pose_.x_m < views()[1].x_m - 0.05;
      if (before_its_end) fastest = std::max(fastest, std::abs(outputs.motion.speed_mps));
    }
    EXPECT_EQ(state_.drive, DriveState::kArrived) << state_.reason;
    return fastest;
  };
  EXPECT_GT(fastest_mps(false, 1), 0.3);
  const double slow_mps = fastest_mps(true, 2);
  EXPECT_LE(slow_mps, 0.25);
  EXPECT_GT(slow_mps, 0.1);
}

TEST_F(StepTest, TheRangeSensorHasTheLastWord) {
  set_off();
  ranges_m_.assign(90, 0.4F);  // walled in all round
  for (int k = 0; k < 5; ++k) EXPECT_LE(tick({permit("m1", 1, ++seq_)}).motion.speed_mps, 0.0);
  ASSERT_TRUE(state_.min_range_m);
  EXPECT_NEAR(*state_.min_range_m, 0.4, 1e-6);
}

}  // namespace
}  // namespace homeward::driving::permitted_test
