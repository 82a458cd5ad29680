// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "scenario/drive_loop.hpp"
#include "scenario/mission_run.hpp"
#include "sim/generate/worlds.hpp"
#include "support/sample_cameras.hpp"
#include "wire/appearance_blob.hpp"

namespace homeward::scenario::answered_test {
namespace {

/// A drive of 1.2 m along the corridor of the generated offices, in light that costs nothing, to a destination that the
/// robot is never certain of by itself.
class Answered : public ::testing::Test {
 protected:
  Answered() : world_(sim::generate_offices(1)) {
    sim::Irradiance even;
    even.corners.setConstant(world_.fine_scene().vertices_m.rows(), 3, 0.6F);
    EXPECT_TRUE(world_.set_irradiance(sim::LightPreset::kDay, std::move(even)));
    camera_config_ = homeward::testing::small_mirror_camera();
    const auto camera = camera::Camera::create(camera_config_);
    features_ = pipeline::suited_feature_config(**camera);
    eye_.emplace(std::move(*pipeline::Eye::create(camera_config_, features_)));
    renderer_.emplace(world_, sim::LightPreset::kDay, *camera);
  }

  std::vector<std::uint8_t> view_at(const Pose2& pose) {
    return wire::encode_appearance(*eye_->look(renderer_->render(pose, {}, 5)));
  }

  wire::MissionOrder order() {
    wire::MissionOrder order;
    order.mission = MissionId("m1");
    order.order = {1, 1};
    order.feature_config_id = features::feature_config_id(features_);
    order.valid_for_ms = 1500;
    order.speed_limit_mps = wire::kSpeedLimit_mps;
    order.label = "lift";
    for (const double x_m : {2.0, 2.6}) {
      wire::PathPlace place{PlaceId("p" + std::to_string(order.path.size())), ImageId("tour/on_the_way.jpg"),
                            view_at({x_m, 1.1, 0.0}), wire::PathEdge{0.0, 0.0, 0.6, false}};
      order.path.push_back(std::move(place));
    }
    order.path.back().next.reset();
    order.final_image = ImageId("tour/goal.jpg");
    order.final_appearance = view_at(kThere);
    wire::Surroundings around;
    around.path = {{2.0, 1.1, 0.0}, {2.6, 1.1, 0.0}};
    around.final_pose = kThere;
    order.surroundings = std::move(around);
    return order;
  }

  /// How it ended, in the robot's words.
  std::optional<wire::ReasonCode> drive(const std::string& answers) {
    SimulatedRobotConfig config;
    config.camera = camera_config_;
    auto robot = SimulatedRobot::create(world_, config, {2.0, 1.1, 0.0});
    driving::DrivingConfig driving;
    driving.body = body_of(robot->vehicle().profile());
    driving.feature_config_id = features::feature_config_id(features_);
    driving.follow.arrived_probability = 1.01;
    driving.asks_ms = 5000;
    const ScenarioListener listener;
    DriveLoop loop(*robot, *eye_, FaultSchedule({}), driving, listener, nullptr);
    loop.answer_by(answers_named(answers, kThere).value());
    EXPECT_TRUE(loop.run(order()));
    EXPECT_EQ(loop.state().drive, answers == "nobody" ? wire::DriveState::kFailed : wire::DriveState::kStopped);
    EXPECT_EQ(loop.state().asking.number, 1);
    EXPECT_LT(std::hypot(robot->vehicle().pose().x_m - kThere.x_m, robot->vehicle().pose().y_m - kThere.y_m), 0.3);
    ended_s_ = loop.elapsed_s();
    return loop.stops().empty() ? std::nullopt : std::optional(loop.stops().back().reason.code);
  }

  static constexpr Pose2 kThere{3.2, 1.1, 0.0};
  sim::LitWorld world_;
  camera::CameraConfig camera_config_;
  features::FeatureConfig features_;
  std::optional<pipeline::Eye> eye_;
  std::optional<sim::Renderer> renderer_;
  double ended_s_ = 0.0;
};

TEST_F(Answered, SomebodyAnswersTwoSecondsAfterItAsks) {
  EXPECT_EQ(drive("right"), wire::ReasonCode::kDestinationAffirmed);
  const double answered_s = ended_s_;
  EXPECT_EQ(drive("nobody"), wire::ReasonCode::kDestinationUnsure);
  EXPECT_NEAR(ended_s_ - answered_s, 3.0, 0.25) << "it waits 5 s, and somebody answers after 2 s";
}

}  // namespace
}  // namespace homeward::scenario::answered_test
