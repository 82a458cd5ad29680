// SPDX-License-Identifier: Apache-2.0
#include "agent/explore/exploring.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "imageio/decode.hpp"
#include "support/drawn_walls.hpp"
#include "support/painted_room.hpp"
#include "support/reason_printing.hpp"
#include "support/sample_cameras.hpp"
#include "support/scratch_folder.hpp"

namespace homeward::agent::exploring_test {
namespace {

using wire::ReasonCode;

/// The loop of a robot that stands in a painted room.
class ExploringTest : public ::testing::Test {
 protected:
  ExploringTest()
      : camera_(camera::Camera::create(homeward::testing::sphere_camera(320)).value()),
        eye_(pipeline::Eye::create(camera_->config(), pipeline::suited_feature_config(*camera_)).value()) {
    homeward::testing::add_box(walls_, -room_.half_length_m, -room_.half_width_m, room_.half_length_m,
                               room_.half_width_m);
    const Image image = homeward::testing::painted_picture(room_, {}, *camera_);
    jpeg_ = std::make_shared<const std::vector<std::uint8_t>>(imageio::encode_jpeg(image, 95));
    seen_ = std::make_shared<const features::Appearance>(*eye_.look(*imageio::decode(*jpeg_, "picture")));
    ThinkerOptions options;
    options.folder = folder_.path();
    options.log = [](const std::string&) {};
    options.upload = [](const KeptFiles&, const std::string&, const std::function<bool(double)>&) -> Result<TourId> {
      return fail(ErrorCode::kIo, "There is no server.", "server");
    };
    exploring_ = Exploring::create(options, camera_->config(), eye_).value();
  }

  static wire::ExploreOrder order(const std::string& mission, bool goes_on) {
    return {MissionId(mission), {1, 1}, 1500, 0.4, ExplorationId("x1"), goes_on, {}, {}, {}};
  }
  /// What an order is refused for.
  std::optional<wire::Reason> refusal(const wire::ExploreOrder& order) {
    driving::Inputs inputs;
    inputs.messages = {order};
    exploring_->prepare(inputs, state_);
    return inputs.why_not_exploring;
  }
  /// One cycle of the loop, in which the driving step obeys what it is given.
  driving::Inputs cycle(std::vector<wire::ServerMessage> messages = {}) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    now_ms_ += 40;
    driving::Inputs inputs;
    inputs.link_up = true;
    inputs.sensors_now_ms = now_ms_;
    inputs.odometry = odometry_;
    inputs.messages = std::move(messages);
    if (sweeps_) inputs.scan = driving::SeenScan{now_ms_, sweep_of(walls_, {})};
    inputs.picture = driving::SeenPicture{now_ms_, seen_, {}, odometry_};
    exploring_->prepare(inputs, state_);
    for (const wire::ServerMessage& message : inputs.messages) {
      const auto* order = std::get_if<wire::ExploreOrder>(&message);
      if (order == nullptr) continue;
      driving::Mission mission;
      mission.id = order->mission;
      mission.explores = true;
      state_.mission = std::make_shared<const driving::Mission>(std::move(mission));
      state_.drive = wire::DriveState::kDriving;
    }
    exploring_->follow(inputs, jpeg_, state_, now_ms_);
    return inputs;
  }
  /// Cycles until one is as asked; whether one was.
  template <class IsSo>
  bool until(const IsSo& is_so) {
    for (int k = 0; k < 2000; ++k)
      if (is_so(cycle())) return true;
    return false;
  }
  /// What goes to the server of how far it is.
  std::optional<wire::ExplorationReport> take_report() {
    const auto message = exploring_->take_report();
    if (!message) return std::nullopt;
    return std::get<wire::Explored>(wire::decode_agent_message(*message).value()).exploration;
  }
  bool until_leg() {
    return until([](const driving::Inputs& inputs) { return inputs.leg.has_value(); });
  }

  homeward::testing::ScratchFolder folder_;
  homeward::testing::PaintedRoom room_{2.6, 2.1, 1.4, -1.2, 1};
  std::shared_ptr<const camera::Camera> camera_;
  pipeline::Eye eye_;
  std::vector<testing::DrawnWall> walls_;
  recording::PictureBytes jpeg_;
  std::shared_ptr<const features::Appearance> seen_;
  std::unique_ptr<Exploring> exploring_;
  driving::DrivingState state_;
  driving::Milliseconds now_ms_ = 10'000;
  Pose2 odometry_;
  bool sweeps_ = true;
};

TEST_F(ExploringTest, ASecondProgramDoesNotExploreIntoTheSameFolder) {
  ThinkerOptions options;
  options.folder = folder_.path();
  const auto second = Exploring::create(options, camera_->config(), eye_);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, ErrorCode::kConflict);
  EXPECT_EQ(second.error().where, folder_.path().string());
}

TEST_F(ExploringTest, WhatItDoesNotHaveItDoesNotGoOnWith) {
  EXPECT_EQ(refusal(order("m1", true)), wire::Reason{ReasonCode::kExplorationUnknown});
  EXPECT_FALSE(refusal(order("m1", false)));
  cycle({order("m1", false)});
  ASSERT_TRUE(until_leg());
  EXPECT_FALSE(refusal(order("m2", true)));
}

TEST_F(ExploringTest, WithoutAnOrderItNamesNoWay) {
  for (int k = 0; k < 50; ++k) EXPECT_FALSE(cycle().leg);
}

TEST_F(ExploringTest, AStopTakesTheLegAwayAtOnce) {
  cycle({order("m1", false)});
  ASSERT_TRUE(until_leg());
  state_.drive = wire::DriveState::kStopped;
  for (int k = 0; k < 20; ++k) EXPECT_FALSE(cycle().leg);
  EXPECT_FALSE(cycle({order("m2", true)}).leg) << "what was said of the mission before";
  EXPECT_TRUE(until_leg());
}

TEST_F(ExploringTest, WhereOdometryJumpsTheLegIsGoneInTheNextStepAndTheDriveEnds) {
  cycle({order("m1", false)});
  ASSERT_TRUE(until_leg());
  odometry_ = {5.0, 0.0, 0.0};
  cycle();
  EXPECT_FALSE(cycle().leg);
  EXPECT_TRUE(
      until([](const driving::Inputs& inputs) { return inputs.exploration_over && inputs.exploration_over->failed; }));
}

TEST_F(ExploringTest, AfterSweepsStayedAwayItDoesNotBelieveToStandWhereItStood) {
  cycle({order("m1", false)});
  ASSERT_TRUE(until_leg());
  sweeps_ = false;
  for (int k = 0; k < 20; ++k) cycle();
  sweeps_ = true;
  cycle();
  EXPECT_FALSE(cycle().leg);
}

TEST_F(ExploringTest, RowsOfItsTableOfStatesAreGivenOnceAndInOrder) {
  cycle({order("m1", false)});
  ASSERT_TRUE(until_leg());
  const std::vector<wire::StateRow> rows = exploring_->take_rows();
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(wire::state_name(rows[0]), "new");
  EXPECT_EQ(wire::state_name(rows[1]), "next_place");
  EXPECT_EQ(std::get<wire::SurveyRow>(rows[0]).picture, 0);
  ASSERT_TRUE(std::get<wire::SurveyRow>(rows[1]).place_m);
  EXPECT_TRUE(exploring_->take_rows().empty());
}

TEST_F(ExploringTest, WhoIsWelcomedIsToldHowFarItIs) {
  EXPECT_FALSE(take_report());
  cycle({order("m1", false)});
  ASSERT_TRUE(until_leg());
  while (take_report()) {
  }
  state_.drive = wire::DriveState::kStopped;
  ASSERT_TRUE(until([this](const driving::Inputs&) {
    const auto report = take_report();
    return report && report->phase == wire::ExplorationPhase::kPaused;
  }));
  cycle({wire::Welcome{}});
  const auto again = take_report();
  ASSERT_TRUE(again);
  EXPECT_EQ(again->phase, wire::ExplorationPhase::kPaused);
  EXPECT_FALSE(take_report());
}

}  // namespace
}  // namespace homeward::agent::exploring_test
