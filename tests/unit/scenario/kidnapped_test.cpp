// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

#include "core/angles.hpp"
#include "scenario/drive_loop.hpp"
#include "scenario/look_alike_spot.hpp"
#include "scenario/mission_run.hpp"
#include "sim/floor.hpp"
#include "sim/generate/worlds.hpp"
#include "support/sample_cameras.hpp"
#include "wire/appearance_blob.hpp"

namespace homeward::scenario::kidnapped_test {
namespace {

/// The generated offices, eight that look alike along a corridor, in light that costs nothing, and places of them.
class Kidnapped : public ::testing::Test {
 protected:
  Kidnapped() {
    taught_.world = std::make_unique<sim::LitWorld>(sim::generate_offices(1));
    sim::Irradiance even;
    even.corners.setConstant(taught_.world->fine_scene().vertices_m.rows(), 3, 0.6F);
    EXPECT_TRUE(taught_.world->set_irradiance(sim::LightPreset::kDay, std::move(even)));
    taught_.camera = homeward::testing::small_mirror_camera();
    const auto camera = camera::Camera::create(taught_.camera);
    features_ = pipeline::suited_feature_config(**camera);
    eye_.emplace(std::move(*pipeline::Eye::create(taught_.camera, features_)));
    renderer_.emplace(*taught_.world, sim::LightPreset::kDay, *camera);
  }

  features::Appearance seen_at(const Pose2& pose) { return *eye_->look(renderer_->render(pose, {}, 5)); }

  SimulatedRobot robot_at(const Pose2& start) {
    SimulatedRobotConfig config;
    config.camera = taught_.camera;
    return std::move(*SimulatedRobot::create(*taught_.world, config, start));
  }

  void teach(const std::vector<Pose2>& poses) {
    auto map = std::make_shared<map::TopologicalMap>();
    for (const Pose2& pose : poses) {
      const std::string number = std::to_string(map->places.size());
      map::Place place{PlaceId("p" + number), {}, ImageId("tour/" + number + ".jpg"), {}, {seen_at(pose)}};
      taught_.picture_poses.emplace(place.prototype, pose);
      map->places.push_back(std::move(place));
    }
    taught_.map = std::move(map);
  }

  [[nodiscard]] std::string room_of(const Pose2& pose) const {
    return sim::room_at(taught_.world->world(), {pose.x_m, pose.y_m}).value_or("");
  }

  /// A drive along the corridor to a picture taken 1.2 m ahead; the robot is kidnapped after half a second, to where
  /// `spot` says for where it is.
  MissionResult drive(const std::function<std::optional<Pose2>(const Pose2&)>& spot) {
    const Pose2 start{2.0, 1.1, 0.0};
    SimulatedRobot robot = robot_at(start);
    wire::MissionOrder order;
    order.mission = MissionId("m1");
    order.order = {1, 1};
    order.feature_config_id = features::feature_config_id(features_);
    order.valid_for_ms = 1500;
    order.speed_limit_mps = wire::kSpeedLimit_mps;
    order.final_image = ImageId("tour/goal.jpg");
    order.final_appearance = wire::encode_appearance(seen_at({3.2, 1.1, 0.0}));
    driving::DrivingConfig config;
    config.body = body_of(robot.vehicle().profile());
    config.feature_config_id = order.feature_config_id;
    config.blind_ms = 2000;
    config.stuck_ms = 6000;
    const ScenarioListener listener;
    DriveLoop loop(robot, *eye_, FaultSchedule({{wire::FaultKind::kKidnapped, 0.5, 0.0}}), config, listener, nullptr);
    loop.kidnap_to([&]() -> Result<std::optional<Pose2>> {
      before_ = robot.vehicle().pose();
      odometry_ = robot.odometry();
      return spot(before_);
    });
    EXPECT_TRUE(loop.run(order));
    MissionResult result;
    result.arrived = loop.state().drive == wire::DriveState::kArrived;
    result.kidnapped_at_s = loop.kidnapped_at_s();
    result.noticed_after_s = loop.noticed_after_s();
    result.stops = loop.stops();
    result.duration_s = loop.elapsed_s();
    judge(robot.vehicle(), {3.2, 1.1, 0.0}, result);
    odometry_way_m_ = std::hypot(robot.odometry().x_m - odometry_.x_m, robot.odometry().y_m - odometry_.y_m);
    return result;
  }

  MissionResult drive(const std::optional<Pose2>& spot) {
    return drive([&](const Pose2&) { return spot; });
  }

  TaughtWorld taught_;
  features::FeatureConfig features_;
  std::optional<pipeline::Eye> eye_;
  std::optional<sim::Renderer> renderer_;
  Pose2 before_;                 // where the robot was when it was lifted
  Pose2 odometry_;               // what its wheels said then
  double odometry_way_m_ = 0.0;  // what they have said since, straight
};

TEST_F(Kidnapped, ToTheOfficeThatLooksAlikeTurnedSoThatTheViewDoes) {
  // In offices 2 and 3 and the corridor with other headings than the robot's, and too near to it.
  teach({{6.0, 4.4, 0.3}, {10.0, 4.4, -2.0}, {14.0, 1.1, 0.0}, {9.0, 1.1, 3.1}, {2.2, 4.4, 1.5}});
  const Pose2 here{2.0, 4.4, 1.2};
  SimulatedRobot robot = robot_at(here);
  const auto spot = look_alike_spot(taught_, robot, *eye_);
  ASSERT_TRUE(spot && *spot);
  EXPECT_TRUE(std::set<std::string>({"office_2", "office_3"}).contains(room_of(**spot))) << room_of(**spot);
  EXPECT_NEAR(wrap_angle((*spot)->theta_rad - here.theta_rad), 0.0, 0.1);
  EXPECT_GE(std::hypot((*spot)->x_m - here.x_m, (*spot)->y_m - here.y_m), kLeastLift_m - 1e-9);
  EXPECT_GE(robot.clearance_m(**spot), kLiftClearance_m);
}

TEST_F(Kidnapped, NowhereThatLeavesItsBodyNoRoom) {
  teach({{6.0, 4.4, 0.3}, {10.0, 4.4, -2.0}});
  const auto seen = seen_at({2.0, 4.4, 1.2});
  EXPECT_FALSE(look_alike_spot(taught_, {2.0, 4.4, 1.2}, seen, [](const Pose2&) { return 0.04; }));
  const auto free = [](const Pose2& pose) { return pose.x_m > 9.0 ? 0.06 : 0.04; };
  const auto spot = look_alike_spot(taught_, {2.0, 4.4, 1.2}, seen, free);
  ASSERT_TRUE(spot);
  EXPECT_EQ(room_of(*spot), "office_3");
}

TEST_F(Kidnapped, KeepsItsHeadingToTheTourWhereNothingIsSeen) {
  teach({{2.0, 3.9, 0.5}, {6.0, 4.4, -0.7}, {8.0, 4.0, 0.0}});
  // Office 3 begins beyond x = 8: the corridor's spot counts less than another room's.
  const auto spot =
      look_alike_spot(taught_, {2.0, 4.4, 1.5}, {}, [](const Pose2& pose) { return pose.x_m > 7.0 ? 0.0 : 1.0; });
  ASSERT_TRUE(spot);
  EXPECT_DOUBLE_EQ(spot->x_m, 6.0);
  EXPECT_NEAR(spot->theta_rad, -0.7 + 1.0, 1e-9);
}

TEST_F(Kidnapped, TheMissionSaysHowSoonItWasToldOf) {
  const Pose2 spot{6.0, 3.6, 2.0};  // in an office, not the corridor
  const MissionResult result = drive(spot);
  EXPECT_FALSE(result.arrived);
  ASSERT_TRUE(result.kidnapped_at_s);
  EXPECT_NEAR(*result.kidnapped_at_s, 0.5, 1e-9);
  ASSERT_TRUE(result.noticed_after_s);
  ASSERT_FALSE(result.stops.empty());
  EXPECT_NEAR(*result.kidnapped_at_s + *result.noticed_after_s, result.stops.front().t_s, 0.11);
  EXPECT_NEAR(before_.y_m, 1.1, 0.1);
  EXPECT_LT(odometry_way_m_, result.path_m + 0.1) << "odometry does not jump";
  EXPECT_LT(result.path_m, 2.0) << "the lift is no way driven";
  EXPECT_GT(result.final_error_m, 2.0) << "it stands where it was put";
  EXPECT_EQ(result.collisions, 0);
}

TEST_F(Kidnapped, TheMissionSaysThatItNeverWasToldOf) {
  const MissionResult result = drive([](const Pose2& here) {  // hardly anywhere else
    return std::optional(here * Pose2{0.02, 0.0, 0.0});
  });
  EXPECT_TRUE(result.arrived);
  EXPECT_TRUE(result.kidnapped_at_s);
  EXPECT_FALSE(result.noticed_after_s);
}

TEST_F(Kidnapped, NotWhereThereIsNoOtherSpot) {
  const MissionResult result = drive(std::nullopt);
  EXPECT_TRUE(result.arrived);
  EXPECT_FALSE(result.kidnapped_at_s);
  EXPECT_FALSE(result.noticed_after_s);
}

}  // namespace
}  // namespace homeward::scenario::kidnapped_test
