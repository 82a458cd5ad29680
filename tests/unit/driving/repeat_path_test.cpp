// SPDX-License-Identifier: Apache-2.0
#include "driving/repeat_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "unit/driving/step_fixture.hpp"

namespace homeward::driving::repeat_path_test {
namespace {

using wire::DriveState;
using wire::ReasonCode;

/// Two metres straight on, a right angle on the spot to the left, and one metre more.
std::vector<Pose2> way_with_corner() {
  std::vector<Pose2> way;
  for (int i = 0; i <= 20; ++i) way.push_back({0.1 * i, 0.0, 0.0});
  for (int i = 1; i <= 3; ++i) way.push_back({2.0, 0.0, i * 0.5 * kPi / 3.0});
  for (int i = 1; i <= 10; ++i) way.push_back({2.0, 0.1 * i, 0.5 * kPi});
  return way;
}

class RepeatPathTest : public StepTest {
 protected:
  void SetUp() override {
    tick({repeat("m1", {1, 1})});
    seq_ = 1;
  }
  static wire::RepeatOrder repeat(const std::string& mission, const wire::Order& order) {
    return {MissionId(mission), order, MapId("k1"), 1, 1500, 0.6, "kitchen", ImageId("tour/1.jpg"), 0};
  }
  /// What an ideal eye sees of the way.
  PathSight sight() {
    PathSight seen;
    seen.taken_ms = now_ms_;
    seen.odometry = pose_;
    seen.lost = false;
    seen.confidence = confidence_;
    seen.steering_rad = steering_rad_;
    if (!in_metres_) return seen;
    double least = 1e9;
    std::size_t here = from_;
    for (std::size_t i = from_; i < std::min(way_.size(), from_ + 8); ++i) {
      const Pose2 there = inverse(pose_) * way_[i];
      const double off = std::hypot(there.x_m, there.y_m, 0.5 * there.theta_rad);
      if (off < least) here = i;
      least = std::min(least, off);
    }
    from_ = here;
    for (std::size_t i = here; i < std::min(way_.size(), here + 25); ++i) seen.way.push_back(inverse(pose_) * way_[i]);
    seen.ends = here + 25 >= way_.size();
    return seen;
  }
  Outputs on() {
    path_sight_ = lost_ ? PathSight{} : sight();
    const Outputs outputs = tick({permit("m1", 1, ++seq_)});
    double beside_m = 1e9;
    for (std::size_t i = 0; i + 1 < way_.size(); ++i) {
      const Eigen::Vector2d from_m = position_m(way_[i]);
      const Eigen::Vector2d way_m = position_m(way_[i + 1]) - from_m;
      const double along = (position_m(pose_) - from_m).dot(way_m) / std::max(1e-12, way_m.squaredNorm());
      beside_m = std::min(beside_m, (position_m(pose_) - from_m - std::clamp(along, 0.0, 1.0) * way_m).norm());
    }
    most_beside_m_ = std::max(most_beside_m_, beside_m);
    return outputs;
  }

  std::vector<Pose2> way_ = way_with_corner();
  std::size_t from_ = 0;
  bool lost_ = false;
  bool in_metres_ = true;
  double confidence_ = 0.9;
  double steering_rad_ = 0.0;
  double most_beside_m_ = 0.0;
};

TEST_F(RepeatPathTest, ItDrivesTheWayRoundItsCornerAndTakesTheHeadingAtItsEnd) {
  for (int k = 0; k < 800 && state_.drive == DriveState::kDriving; ++k) on();
  EXPECT_EQ(state_.drive, DriveState::kArrived) << state_.reason;
  EXPECT_NEAR(pose_.x_m, 2.0, 0.05);
  EXPECT_NEAR(pose_.y_m, 1.0, 0.05);
  EXPECT_NEAR(pose_.theta_rad, 0.5 * kPi, 0.03);
  EXPECT_LT(most_beside_m_, 0.1) << "the corner is not cut";
}

TEST_F(RepeatPathTest, WhereTheWayTurnsRoundOnTheSpotItMakesRoomForNobody) {
  way_.clear();
  for (int i = 0; i <= 20; ++i) way_.push_back({0.1 * i, 0.0, 0.0});
  for (int i = 1; i <= 10; ++i) way_.push_back({2.0, 0.0, 0.3 * i});
  for (int i = 1; i <= 15; ++i) way_.push_back({2.0 + 0.1 * i * std::cos(3.0), 0.1 * i * std::sin(3.0), 3.0});
  for (int k = 0; k < 800 && state_.drive == DriveState::kDriving; ++k) {
    on();
    ASSERT_EQ(state_.give_way.phase, GiveWay::Phase::kOnTheWay) << k << ": nobody stands there";
  }
  EXPECT_EQ(state_.drive, DriveState::kArrived) << state_.reason;
  EXPECT_LT(most_beside_m_, 0.1);
}

TEST_F(RepeatPathTest, BegunBesideTheWayItComesBackToIt) {
  pose_ = {0.0, 0.3, 0.17};
  for (int k = 0; k < 80; ++k) on();
  EXPECT_GT(pose_.x_m, 0.5);
  EXPECT_NEAR(pose_.y_m, 0.0, 0.08);
}

TEST_F(RepeatPathTest, WhereItDoesNotKnowWhereItIsItStandsAndGivesUpInTheEnd) {
  for (int k = 0; k < 20; ++k) on();
  const double before_m = pose_.x_m;
  lost_ = true;
  for (int k = 0; k < 40; ++k) on();
  EXPECT_TRUE(stands(on()));
  EXPECT_LT(pose_.x_m - before_m, config_.repeat_path.blind_m + 0.1);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kPathPlaceUnknown});
  EXPECT_EQ(state_.drive, DriveState::kDriving);
  for (int k = 0; k < 200 && state_.drive == DriveState::kDriving; ++k) on();
  EXPECT_EQ(state_.drive, DriveState::kFailed);
  EXPECT_TRUE(state_.astray) << "no part of the way is to blame";
}

TEST_F(RepeatPathTest, WhereNothingIsHeldAgainstThePathAnyMoreItStandsAndGivesUp) {
  for (int k = 0; k < 20; ++k) on();
  ASSERT_GT(pose_.x_m, 0.1);
  for (int k = 0; k < 30; ++k) tick({permit("m1", 1, ++seq_)});
  EXPECT_TRUE(stands(tick({permit("m1", 1, ++seq_)})));
  for (int k = 0; k < 250 && state_.drive == DriveState::kDriving; ++k) tick({permit("m1", 1, ++seq_)});
  EXPECT_EQ(state_.drive, DriveState::kFailed);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kPathPlaceUnknown});
}

TEST_F(RepeatPathTest, WhatAnOldPictureSaysIsNotDriven) {
  path_sight_ = sight();
  path_sight_->taken_ms = now_ms_ - 3000;
  for (int k = 0; k < 10; ++k) EXPECT_TRUE(stands(tick({permit("m1", 1, ++seq_)})));
}

TEST_F(RepeatPathTest, WhereOdometryBeginsAnewItStandsUntilANewPictureSaysWhereItIs) {
  for (int k = 0; k < 20; ++k) on();
  const PathSight before = sight();
  pose_ = {pose_.x_m, pose_.y_m, 1.5};
  path_sight_ = before;
  EXPECT_TRUE(stands(tick({permit("m1", 1, ++seq_)})));
  for (int k = 0; k < 5; ++k) EXPECT_TRUE(stands(tick({permit("m1", 1, ++seq_)})));
  from_ = 0;
  way_.clear();
  for (int i = 0; i <= 20; ++i) way_.push_back(pose_ * Pose2{0.1 * i, 0.0, 0.0});
  for (int k = 0; k < 10; ++k) on();
  EXPECT_FALSE(stands(on()));
}

TEST_F(RepeatPathTest, AtItsEndItTakesNoHeadingOfAnotherPlace) {
  way_.back().theta_rad -= 0.5 * kPi;
  for (int k = 0; k < 800 && !state_.repeat.at_end && state_.drive == DriveState::kDriving; ++k) on();
  ASSERT_TRUE(state_.repeat.at_end);
  ASSERT_EQ(state_.drive, DriveState::kDriving);
  path_sight_ = sight();
  path_sight_->way = {{1.0, 0.0, 0.0}, {1.5, 0.0, 0.0}};
  path_sight_->ends = false;
  tick({permit("m1", 1, ++seq_)});
  EXPECT_EQ(state_.drive, DriveState::kDriving) << "it is not there";
  EXPECT_FALSE(state_.repeat.at_end);
}

TEST_F(RepeatPathTest, AWayThatIsNotFiniteIsNoWay) {
  path_sight_ = sight();
  path_sight_->way[3].y_m = std::nan("");
  for (int k = 0; k < 10; ++k) EXPECT_TRUE(stands(tick({permit("m1", 1, ++seq_)})));
}

TEST_F(RepeatPathTest, HoweverLongThePathTakesToComeItLooksForItsPlaceAsLong) {
  for (int k = 0; k < 400; ++k) tick({permit("m1", 1, ++seq_)});
  lost_ = true;
  for (int k = 0; k < 20; ++k) on();
  EXPECT_EQ(state_.drive, DriveState::kDriving);
}

TEST_F(RepeatPathTest, ItGoesOnWhereItIsKnownAgain) {
  lost_ = true;
  for (int k = 0; k < 20; ++k) EXPECT_TRUE(stands(on()));
  lost_ = false;
  for (int k = 0; k < 20; ++k) on();
  EXPECT_GT(pose_.x_m, 0.05);
  EXPECT_FALSE(state_.reason);
}

TEST_F(RepeatPathTest, BeforeThePathIsThereItStandsAndSaysWhy) {
  for (int k = 0; k < 20; ++k) EXPECT_TRUE(stands(tick({permit("m1", 1, ++seq_)})));
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kPathLoads});
  EXPECT_EQ(state_.drive, DriveState::kDriving);
}

TEST_F(RepeatPathTest, APathThatCannotBeUsedEndsItWithItsReason) {
  why_not_repeating_ = wire::Reason{ReasonCode::kDoesNotRepeat};
  on();
  EXPECT_EQ(state_.drive, DriveState::kFailed);
  EXPECT_EQ(state_.reason, wire::reason_with(ReasonCode::kPathUnusable, "because", {ReasonCode::kDoesNotRepeat}));
  const Outputs refused = tick({repeat("m2", {1, 900})});
  ASSERT_EQ(refused.messages.size(), 1U);
  EXPECT_EQ(std::get<wire::MissionRefused>(refused.messages[0]).reason, wire::Reason{ReasonCode::kDoesNotRepeat});
}

TEST_F(RepeatPathTest, APathThatLeadsElsewhereIsNotDriven) {
  path_sight_ = sight();
  path_sight_->leads_elsewhere = true;
  EXPECT_TRUE(stands(tick({permit("m1", 1, ++seq_)})));
  EXPECT_EQ(state_.drive, DriveState::kFailed);
}

TEST_F(RepeatPathTest, ItStopsBeforeAWallAcrossTheWay) {
  for (int k = 0; k < 1500 && state_.drive == DriveState::kDriving; ++k) {
    see_wall_across(1.2);
    on();
  }
  EXPECT_EQ(state_.drive, DriveState::kFailed);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kWayBlocked});
  EXPECT_LT(pose_.x_m, 1.2 - config_.body.outline.radius_m);
}

TEST_F(RepeatPathTest, CarriedFarFromTheWayItGivesUp) {
  for (int k = 0; k < 10; ++k) on();
  path_sight_ = sight();
  for (Pose2& pose : path_sight_->way) pose.y_m += 1.5;
  tick({permit("m1", 1, ++seq_)});
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kOffTheWay});
}

TEST_F(RepeatPathTest, InDoubtItDrivesSlowly) {
  confidence_ = 0.0;
  double most_mps = 0.0;
  for (int k = 0; k < 40; ++k) most_mps = std::max(most_mps, on().motion.speed_mps);
  EXPECT_GT(most_mps, 0.1);
  EXPECT_LE(most_mps, config_.repeat_path.unsure_mps + 1e-9);
}

TEST_F(RepeatPathTest, WithoutMetresItTurnsToWhereFeaturesSay) {
  in_metres_ = false;
  steering_rad_ = 0.3;
  for (int k = 0; k < 20; ++k) on();
  EXPECT_GT(pose_.theta_rad, 0.1);
  EXPECT_GT(pose_.x_m, 0.1);
}

TEST_F(RepeatPathTest, AStopOrderEndsItAndNoPermitBeginsItAgain) {
  for (int k = 0; k < 10; ++k) on();
  EXPECT_TRUE(stands(tick({wire::StopOrder{"s1", 1, std::nullopt, "test"}})));
  EXPECT_EQ(state_.drive, DriveState::kStopped);
  for (int k = 0; k < 10; ++k) EXPECT_TRUE(stands(on()));
}

TEST_F(RepeatPathTest, WithoutPermitsItStops) {
  for (int k = 0; k < 10; ++k) on();
  EXPECT_GT(until_stopped(false), 0);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kPermitOver});
}

}  // namespace
}  // namespace homeward::driving::repeat_path_test
