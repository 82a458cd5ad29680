// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "agent/driving/step.hpp"
#include "unit/agent/step_fixture.hpp"

namespace homeward::agent {
namespace {

using wire::DriveState;

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
  EXPECT_NE(state_.reason.find("another place"), std::string::npos) << state_.reason;
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

TEST_F(StepTest, ABeliefThatIsNotToldAnyMoreSaysNothing) {
  set_off();
  belief_ = belief_of("p77", 0.97);
  tick({permit("m1", 1, ++seq_)});
  ASSERT_TRUE(state_.follow.belief);
  server_talks_ = false;
  until_stopped(true, 30'000);
  EXPECT_FALSE(state_.follow.belief);
  EXPECT_EQ(state_.drive, DriveState::kArrived) << state_.reason;
}

}  // namespace
}  // namespace homeward::agent
