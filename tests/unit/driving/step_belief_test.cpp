// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "driving/step.hpp"
#include "unit/driving/step_fixture.hpp"

namespace homeward::driving::step_belief_test {
namespace {

using wire::DriveState;
using wire::ReasonCode;

wire::BeliefReport belief_of(const char* place, double probability) {
  wire::BeliefReport belief;
  belief.place = PlaceId(place);
  belief.probability = probability;
  belief.lost = false;
  return belief;
}

TEST_F(StepTest, ASureBeliefOfAPlaceThatTheMissionDoesNotTellOfEndsIt) {
  set_off();
  belief_ = belief_of("p77", 0.97);
  const Milliseconds gone_ms = until_stopped(true);
  EXPECT_EQ(state_.drive, DriveState::kFailed);
  EXPECT_EQ(state_.reason, wire::Reason{ReasonCode::kPlaceDeniedByMap});
  EXPECT_TRUE(state_.astray) << "no part of the way is to blame";
  EXPECT_GT(gone_ms, config_.off_belief_ms);
  EXPECT_LE(gone_ms, config_.off_belief_ms + 2 * kTick_ms);
}

TEST_F(StepTest, ABeliefThatIsNotSureOfAnotherPlaceDoesNotEndIt) {
  set_off();
  belief_ = belief_of("p77", 0.6);
  until_stopped(true, 30'000);
  EXPECT_EQ(state_.drive, DriveState::kArrived) << state_.reason;
}

TEST_F(StepTest, ABeliefOfTheNextPlaceDoesNotEndIt) {
  set_off();
  belief_ = belief_of("p0", 0.97);
  until_stopped(true, 2000);
  belief_ = belief_of("p1", 0.97);
  until_stopped(true, 30'000);
  EXPECT_EQ(state_.drive, DriveState::kArrived) << state_.reason;
}

TEST_F(StepTest, WhileTheBeliefIsLostItHasNotArrived) {
  set_off();
  belief_.lost = true;
  for (int k = 0; k < 1000 && state_.drive == DriveState::kDriving && !state_.asking.since_ms; ++k)
    tick({permit("m1", 1, ++seq_)});
  ASSERT_EQ(state_.drive, DriveState::kDriving) << state_.reason;
  EXPECT_TRUE(state_.asking.since_ms) << "beside its destination it asks";
  belief_.lost = false;
  EXPECT_GE(until_stopped(true), 0);
  EXPECT_EQ(state_.drive, DriveState::kArrived) << state_.reason;
}

TEST_F(StepTest, OneReportDoesNotMakeTheBeliefLostOrFindItAgain) {
  set_off();
  const auto after = [&](bool lost, int ticks) {
    belief_.lost = lost;
    for (int k = 0; k < ticks; ++k) tick({permit("m1", 1, ++seq_)});
    return state_.follow.belief_lost;
  };
  EXPECT_FALSE(after(true, 10));
  EXPECT_FALSE(after(false, 1));
  EXPECT_FALSE(after(true, 19)) << "counted anew";
  EXPECT_TRUE(after(true, 5));
  EXPECT_TRUE(after(false, 10));
  EXPECT_TRUE(after(true, 1));
  EXPECT_FALSE(after(false, 21));
}

TEST_F(StepTest, ThatTheBeliefIsLostIsForgottenWhenItIsNotSaidAnyMore) {
  set_off();
  belief_.lost = true;
  for (int k = 0; k < 30; ++k) tick({permit("m1", 1, ++seq_)});
  ASSERT_TRUE(state_.follow.belief_lost);
  server_talks_ = false;
  until_stopped(true, 30'000);
  EXPECT_EQ(state_.drive, DriveState::kArrived) << state_.reason;
}

TEST_F(StepTest, ABeliefThatIsNotSaidAnyMoreSaysNothing) {
  set_off();
  belief_ = belief_of("p77", 0.97);
  tick({permit("m1", 1, ++seq_)});
  ASSERT_TRUE(state_.follow.belief);
  server_talks_ = false;
  until_stopped(true, 30'000);
  EXPECT_FALSE(state_.follow.belief);
  EXPECT_EQ(state_.drive, DriveState::kArrived) << state_.reason;
}

/// A mission whose views are seen just as well 30 m to the side, where the map has others that look like them.
wire::MissionOrder between_two_halls(wire::MissionOrder order, const std::vector<Pose2>& views) {
  wire::Surroundings around;
  around.path.assign(views.begin(), views.end() - 1);
  around.final_pose = views.back();
  around.spread_m = 0.05;
  around.start_probability = 0.6;
  const auto add = [&](const Pose2& pose, const std::vector<std::uint8_t>& appearance) {
    const std::string name = "twin" + std::to_string(around.nearby.size());
    around.nearby.push_back({PlaceId(name), ImageId("tour/" + name + ".jpg"), {pose.x_m, 30.0, 0.0}, appearance});
  };
  for (std::size_t i = 0; i + 1 < views.size(); ++i) add(views[i], order.path[i].appearance);
  add(views.back(), order.final_appearance);
  order.surroundings = around;
  return order;
}

TEST_F(StepTest, BetweenTwoPlacesThatLookTheSameItLooksAroundForAWhileAndThenGoesOnByTheLikelierOne) {
  tick({between_two_halls(mission("m1", 1, 1), views())});
  const Milliseconds from_ms = now_ms_;
  while (!state_.follow.looked_around && now_ms_ - from_ms < 30'000) tick({permit("m1", 1, ++seq_)});
  EXPECT_GT(now_ms_ - from_ms, config_.looks_ms);
  EXPECT_LE(now_ms_ - from_ms, config_.looks_ms + 1000);
  ASSERT_EQ(state_.drive, DriveState::kDriving) << state_.reason;
  EXPECT_LT(state_.follow.hypotheses.best_probability(), config_.follow.drive_above);
  double fastest_mps = 0.0;
  const Pose2 there = views().back();
  const auto left_m = [&] { return std::hypot(there.x_m - pose_.x_m, there.y_m - pose_.y_m); };
  double nearest_m = left_m();
  while (state_.drive == DriveState::kDriving && now_ms_ - from_ms < 59'000) {
    fastest_mps = std::max(fastest_mps, tick({permit("m1", 1, ++seq_)}).motion.speed_mps);
    nearest_m = std::min(nearest_m, left_m());
  }
  EXPECT_LT(nearest_m, 0.3) << "it goes where it was sent";
  EXPECT_LE(fastest_mps, 0.25) << "slowly";
  EXPECT_NE(state_.drive, DriveState::kArrived) << "and says nothing that it does not know";
  EXPECT_EQ(state_.reason, (wire::Reason{ReasonCode::kDestinationAsked, {{"destination", "kitchen"}}}));
}

TEST_F(StepTest, AWallThatOneOfTwoPlacesHasNoRoomForTellsItWhereItIs) {
  // A tour of the other hall drove on where this one ends.
  wire::MissionOrder order = between_two_halls(mission("m1", 1, 1), views());
  wire::Surroundings& around = *order.surroundings;
  const int end = static_cast<int>(around.path.size() + around.nearby.size()) - 1;
  around.nearby.push_back({PlaceId("beyond"), ImageId("tour/beyond.jpg"), {5.5, 30.0, 0.0}, order.path[0].appearance});
  around.ways = {{0, 1}, {end, end + 1}};
  ranges_m_.resize(720);
  const auto drive = [&] {
    state_ = {};
    pose_ = {};
    tick({order});
    const Milliseconds from_ms = now_ms_;
    while (state_.drive == DriveState::kDriving && now_ms_ - from_ms < 55'000) {
      see_wall_across(4.0);
      tick({permit("m1", state_.newest.epoch, ++seq_)});
    }
  };
  drive();
  EXPECT_EQ(state_.drive, DriveState::kArrived) << state_.reason;
  config_.body.vague_ranges = true;  // arcs of ultrasound are no walls
  order.order.seq = ++seq_;
  drive();
  EXPECT_NE(state_.drive, DriveState::kArrived);
}

TEST_F(StepTest, OnceItKnowsWhereItIsItLooksAroundAgainBeforeItGoesOnByTheLikelierPlace) {
  set_off();
  state_.follow.looked_around = true;
  tick({permit("m1", 1, ++seq_)});
  EXPECT_FALSE(state_.follow.looked_around);
}

}  // namespace
}  // namespace homeward::driving::step_belief_test
