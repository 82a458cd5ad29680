// SPDX-License-Identifier: Apache-2.0
#include "driving/stated.hpp"

#include "unit/driving/step_fixture.hpp"

namespace homeward::driving::stated_test {
namespace {

using wire::DriveState;

TEST_F(StepTest, StatesNothingOfWhereItIsBeforeItHasSeenAnything) {
  tick();
  EXPECT_EQ(stated_arrival(state_, config_), std::nullopt);
  EXPECT_FALSE(stated_estimate(state_, config_));
  pictures_ = false;
  tick({mission("m1", 1, 1)});
  ASSERT_EQ(state_.drive, DriveState::kDriving);
  EXPECT_EQ(stated_arrival(state_, config_), std::nullopt);
  EXPECT_FALSE(stated_estimate(state_, config_));
}

TEST_F(StepTest, StatesHowProbableItIsThatItHasArrivedFromSettingOffToTheEnd) {
  set_off();
  const double setting_off = stated_arrival(state_, config_).value();
  EXPECT_LT(setting_off, 0.5);
  const auto on_the_way = stated_estimate(state_, config_);
  ASSERT_TRUE(on_the_way);
  EXPECT_TRUE(on_the_way->place == PlaceId("p0") || on_the_way->place == PlaceId("p1")) << on_the_way->place.str();
  EXPECT_GE(on_the_way->probability, config_.follow.drive_above);
  EXPECT_LE(on_the_way->probability, 1.0);
  for (int k = 0; k < 400 && state_.drive == DriveState::kDriving; ++k) tick({permit("m1", 1, ++seq_)});
  ASSERT_EQ(state_.drive, DriveState::kArrived) << state_.reason;
  const double there = stated_arrival(state_, config_).value();
  EXPECT_GE(there, 0.9);
  EXPECT_GT(there, setting_off);
  EXPECT_LE(there, 1.0);
  EXPECT_EQ(stated_estimate(state_, config_).value().place, PlaceId("p1"));
  for (int k = 0; k < 5; ++k) tick();
  EXPECT_EQ(stated_arrival(state_, config_).value(), there) << "it is as it was when it ended";
}

TEST_F(StepTest, OfACoveredCameraItStatesNoPlace) {
  set_off();
  ASSERT_FALSE(stated_places(state_).empty());
  EXPECT_EQ(stated_places(state_).front().place, stated_estimate(state_, config_)->place);
  covered_ = true;
  tick({permit("m1", 1, ++seq_)});
  EXPECT_FALSE(stated_estimate(state_, config_));
  EXPECT_TRUE(stated_places(state_).empty());
}

TEST_F(StepTest, OfOneViewWithoutAMapItStatesNoProbability) {
  wire::MissionOrder order = mission("m1", 1, 1);
  order.path = {order.path.back()};
  order.path.back().image = order.final_image;
  tick({order});
  for (int k = 0; k < 4; ++k) tick({permit("m1", 1, ++seq_)});
  ASSERT_TRUE(state_.mission && state_.mission->path.alone());
  EXPECT_EQ(stated_arrival(state_, config_), std::nullopt) << "there is no map that it could be on";
  EXPECT_FALSE(stated_estimate(state_, config_));
}

}  // namespace
}  // namespace homeward::driving::stated_test
