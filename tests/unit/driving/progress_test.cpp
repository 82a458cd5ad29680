// SPDX-License-Identifier: Apache-2.0
#include "driving/progress.hpp"

#include <gtest/gtest.h>

#include "unit/driving/step_fixture.hpp"

namespace homeward::driving::progress_test {
namespace {

using wire::DriveState;
using wire::ReasonCode;

TEST_F(StepTest, BesideADestinationThatMayNotBeDrivenIntoItArrivesAfterAWhile) {
  set_off();
  // Right beside the destination, measured, and no nearer to be had: something stands on it.
  const Milliseconds from_ms = drive_beside_destination(0.1);
  EXPECT_EQ(state_.drive, DriveState::kArrived) << state_.reason;
  EXPECT_GT(now_ms_ - from_ms, config_.near_ms);
  EXPECT_LE(now_ms_ - from_ms, config_.near_ms + 2 * kTick_ms);
  expect_stays();
}

TEST_F(StepTest, BesideADestinationButNotThatNearItDoesNotArrive) {
  config_.stuck_ms = 60'000;
  set_off();
  drive_beside_destination(config_.near_m + 0.1);
  EXPECT_NE(state_.drive, DriveState::kArrived);
}

TEST_F(StepTest, BesideADestinationItArrivesThoughSomebodyCoversTheCameraNowAndThen) {
  set_off();
  covered_now_and_then_ = true;
  const Milliseconds from_ms = drive_beside_destination(config_.near_m - 0.02);
  EXPECT_EQ(state_.drive, DriveState::kArrived) << state_.reason;
  EXPECT_GE(now_ms_ - from_ms, config_.near_ms);
}

TEST_F(StepTest, BesideADestinationItArrivesHoweverLongItHasBeenHeldUpBefore) {
  config_.stuck_ms = config_.near_ms / 4;
  set_off();
  const Milliseconds from_ms = drive_beside_destination(0.1);
  EXPECT_EQ(state_.drive, DriveState::kArrived) << state_.reason;
  EXPECT_GT(now_ms_ - from_ms, config_.near_ms);
}

TEST_F(StepTest, WhereItCannotTurnToTheHeadingOfItsDestinationItArrivesAndSaysSo) {
  config_.body.outline = {0.0, 0.25, 0.85, 0.325};
  wire::MissionOrder order = mission("m1", 1, 1);
  order.dock = true;
  order.final_appearance = wire::encode_appearance(seen_from(landmarks_, {2.4, 0.0, 1.2}, 7));
  tick({order});
  for (int k = 0; k < 600 && !state_.docking; ++k) tick({permit("m1", 1, ++seq_)});
  ASSERT_TRUE(state_.docking) << state_.reason;
  // Walls on both sides: it could drive on between them, but not turn.
  constexpr double kSide_m = 0.4;
  const double step_rad = 2.0 * kPi / static_cast<double>(ranges_m_.size());
  for (int k = 0; k < 600 && state_.drive == DriveState::kDriving; ++k) {
    for (std::size_t i = 0; i < ranges_m_.size(); ++i) {
      const double across = std::sin(pose_.theta_rad + step_rad * static_cast<double>(i));
      const double wall_m = std::copysign(kSide_m, across) - pose_.y_m;
      ranges_m_[i] = across == 0.0 ? kOpen_m : std::min(kOpen_m, static_cast<float>(wall_m / across));
    }
    tick({permit("m1", 1, ++seq_)});
  }
  EXPECT_EQ(state_.drive, DriveState::kArrived);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kHeadingNotTaken});
  EXPECT_GT(std::abs(wrap_angle(pose_.theta_rad - 1.2)), 0.3);
  expect_stays();
}

TEST_F(StepTest, WhoStandsInTheWayIsMadeRoomForAndTheWayGoesOnOnceItIsFree) {
  constexpr double kWall_m = 1.7;
  set_off();
  double farthest_m = 0.0;
  double nearest_m = 1e9;
  for (int k = 0; k < 400; ++k) {
    see_wall_across(kWall_m);
    tick({permit("m1", 1, ++seq_)});
    ASSERT_EQ(state_.drive, DriveState::kDriving) << state_.reason;
    farthest_m = std::max(farthest_m, pose_.x_m);
    if (pose_.x_m > farthest_m - 0.5) continue;
    nearest_m = pose_.x_m;
    break;
  }
  EXPECT_LT(farthest_m, kWall_m - config_.body.outline.radius_m);
  EXPECT_LT(nearest_m, farthest_m - 0.4);
  ranges_m_.assign(ranges_m_.size(), kOpen_m);
  for (int k = 0; k < 900 && state_.drive == DriveState::kDriving; ++k) tick({permit("m1", 1, ++seq_)});
  EXPECT_EQ(state_.drive, DriveState::kArrived) << state_.reason;
}

TEST_F(StepTest, WhoHidesTheViewWhileRoomIsMadeForThemDoesNotEndTheMissionAndWhoHidesItAfterwardsDoes) {
  constexpr double kWall_m = 1.7;
  config_.blind_ms = 3000;
  set_off();
  const auto drive_until = [&](GiveWay::Phase phase, int ticks) {
    for (int k = 0; k < ticks && state_.drive == DriveState::kDriving && state_.give_way.phase != phase; ++k) {
      see_wall_across(kWall_m);
      tick({permit("m1", 1, ++seq_)});
    }
  };
  drive_until(GiveWay::Phase::kBacking, 400);
  ASSERT_EQ(state_.drive, DriveState::kDriving) << state_.reason;
  hidden_ = true;
  const Milliseconds hidden_ms = now_ms_;
  drive_until(GiveWay::Phase::kOnTheWay, 400);
  EXPECT_EQ(state_.drive, DriveState::kDriving) << state_.reason;
  EXPECT_GT(now_ms_ - hidden_ms, config_.blind_ms);
  ASSERT_EQ(state_.give_way.phase, GiveWay::Phase::kOnTheWay);
  const Milliseconds on_the_way_ms = now_ms_;
  while (state_.drive == DriveState::kDriving && now_ms_ - on_the_way_ms < 10'000) {
    see_wall_across(kWall_m);
    tick({permit("m1", 1, ++seq_)});
  }
  EXPECT_LE(now_ms_ - on_the_way_ms, config_.blind_ms + 2 * kTick_ms);
  EXPECT_EQ(state_.drive, DriveState::kFailed);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kWayNotRecognised});
}

TEST_F(StepTest, TheLastDecimetreLeavesRoomBetweenTheRobotAndAWallBehindTheDestination) {
  constexpr double kRoomThere_m = 0.03;
  const double wall_x_m = views().back().x_m + config_.body.outline.radius_m + kRoomThere_m;
  set_off();
  for (int k = 0; k < 600 && state_.drive == DriveState::kDriving; ++k) {
    see_wall_across(wall_x_m);
    tick({permit("m1", 1, ++seq_)});
  }
  EXPECT_EQ(state_.drive, DriveState::kArrived) << state_.reason;
  EXPECT_GE(wall_x_m - pose_.x_m - config_.body.outline.radius_m, 0.08);
  EXPECT_LE(views().back().x_m - pose_.x_m, config_.near_m);
}

TEST_F(StepTest, AWayThatStaysBlockedFailsTheMission) {
  config_.stuck_ms = 2000;
  set_off();
  ranges_m_.assign(90, 0.4F);
  const Milliseconds after_ms = until_stopped(true, 10'000);
  EXPECT_GT(after_ms, 0);
  EXPECT_LE(after_ms, 2 * config_.stuck_ms);  // the nearest view may count as passed in the meantime
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kWayBlocked});
  expect_stays();
}

TEST_F(StepTest, AWayOnWhichItOnlyGoesToAndFroIsBlockedAsWell) {
  config_.stays_ms = 6000;
  set_off();
  const double there_m = pose_.x_m;
  const double wall_m = there_m + config_.body.outline.radius_m + 0.1;
  const Milliseconds from_ms = now_ms_;
  for (int k = 0; state_.drive == DriveState::kDriving && now_ms_ - from_ms < 15'000; ++k) {
    if (k % 20 == 0) pose_.x_m = there_m - (k % 40 == 0 ? 0.3 : 0.0);  // counts as way gained each time
    see_wall_across(wall_m);
    tick({permit("m1", 1, ++seq_)});
  }
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kWayBlocked});
  EXPECT_GT(now_ms_ - from_ms, config_.stays_ms - 1000);
  EXPECT_LE(now_ms_ - from_ms, config_.stays_ms + 2000);
  expect_stays();
}

TEST_F(StepTest, WhereTheWayIsBlockedAndItMayBeElsewhereNoPartOfTheWayIsToBlame) {
  const auto blocked_with = [&](double rival) {
    state_ = {};
    pose_ = {};
    config_.stuck_ms = 2000;
    wire::MissionOrder order = mission("m1", 1, 1);
    wire::Surroundings around;
    around.path = {views()[0], views()[1]};
    around.final_pose = views()[2];
    around.nearby.push_back({PlaceId("p9"), ImageId("tour/20.jpg"), {20.0, 20.0, 0.0}, order.final_appearance});
    order.surroundings = std::move(around);
    ranges_m_.assign(90, kOpen_m);
    hidden_ = false;
    tick({std::move(order)});
    seq_ = 1;
    for (int k = 0; k < 4; ++k) tick({permit("m1", 1, ++seq_)});
    hidden_ = true;
    const PoseHypothesis here = *state_.follow.hypotheses.best();
    PoseHypothesis there = here;
    there.map_from_robot = {20.0, 20.0, 0.0};
    PoseHypothesis at = here;
    at.weight = 1.0 - rival;
    there.weight = rival;
    state_.follow.hypotheses = PoseHypotheses(config_.follow.pose, {at, there}, 0.0, 0.0);
    ranges_m_.assign(90, 0.4F);
    until_stopped(true, 10'000);
    EXPECT_EQ(state_.drive, DriveState::kFailed) << state_.reason;
  };
  blocked_with(0.2);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kWayBlockedOrElsewhere});
  EXPECT_TRUE(state_.astray);
  ASSERT_TRUE(state_.kept);
  EXPECT_NEAR(state_.kept->hypotheses.best()->map_from_robot.x_m, 20.0, 0.1) << "the next order begins with that";
  blocked_with(0.001);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kWayBlocked});
  EXPECT_FALSE(state_.astray);
}

TEST_F(StepTest, WhoGetsNowhereBecauseItDoesNotKnowWhereDoesNotCallTheWayBlocked) {
  config_.stuck_ms = 2000;
  ticks_per_picture_ = 1;
  set_off();
  state_.follow.bearings.add(pose_, homing::HomeVector{}, true, 1.0);
  state_.follow.measured = false;
  covered_ = true;
  until_stopped(true, 10'000);
  EXPECT_EQ(state_.drive, DriveState::kFailed);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kDestinationNotSeenClearly});
  expect_stays();
}

TEST_F(StepTest, WhereSomebodyMovesInTheWayThatStaysBlockedItWaitsLonger) {
  config_.stuck_ms = 2000;
  config_.stays_ms = 2000;
  config_.patience_ms = 9000;
  set_off();
  const Milliseconds from_ms = now_ms_;
  while (state_.drive == DriveState::kDriving && now_ms_ - from_ms < 30'000) {
    ranges_m_.assign(90, 0.4F);
    const bool aside = (now_ms_ / 1000) % 2 == 0;  // who stands there shifts from one foot to the other
    std::fill(ranges_m_.begin() + 10, ranges_m_.begin() + 25, aside ? 2.5F : 0.6F);
    tick({permit("m1", 1, ++seq_)});
  }
  EXPECT_GT(now_ms_ - from_ms, config_.patience_ms - 1000);
  EXPECT_LE(now_ms_ - from_ms, config_.patience_ms + 2 * config_.stuck_ms);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kWayBlocked});
}

TEST_F(StepTest, DrivesBackToADestinationThatItHasRolledPast) {
  set_off();
  EXPECT_LT(slowest_past_destination(), -0.02);
}

TEST_F(StepTest, DrivesNeverBackwardsWhereTheRangeSensorDoesNotLookBehind) {
  field_rad_ = kPi;
  set_off();
  EXPECT_EQ(slowest_past_destination(), 0.0);
}

}  // namespace
}  // namespace homeward::driving::progress_test
