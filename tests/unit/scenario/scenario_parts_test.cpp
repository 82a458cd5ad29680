// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "scenario/bystander.hpp"
#include "scenario/fault_schedule.hpp"
#include "scenario/mission_plan.hpp"
#include "scenario/simulated_robot.hpp"
#include "scenario/starting_pose.hpp"
#include "sim/floor.hpp"
#include "sim/generate/worlds.hpp"
#include "sim/moved_furniture.hpp"
#include "support/sample_cameras.hpp"

namespace homeward::scenario::scenario_parts_test {
namespace {

class StartingPose : public ::testing::TestWithParam<bool> {
 protected:
  const sim::RobotProfile robot_ = GetParam() ? sim::chair_profile() : sim::disc_profile();
};

TEST_P(StartingPose, LeavesRoomInEveryRoomOfAHouseAlsoWhereFurnitureWasMoved) {
  const sim::World house = sim::generate_house(1);
  const auto moved = sim::move_furniture(house, 1, robot_.outline.radius_m + robot_.outline.side_m, 4);
  ASSERT_TRUE(moved);
  for (const sim::World* world : {&house, &moved->world}) {
    const sim::Obstacles obstacles(*world);
    for (const sim::Room& room : world->rooms) {
      for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const auto pose = starting_pose(*world, obstacles, {room.x_m, room.y_m}, robot_, seed);
        ASSERT_TRUE(pose) << room.name << ": " << pose.error().message;
        EXPECT_GE(obstacles.clearance_of_cells_m(robot_, *pose), kStartClearance_m) << room.name << " " << seed;
      }
    }
  }
}

TEST_P(StartingPose, IsRefusedWhereTheRobotDoesNotFit) {
  sim::World walled = sim::generate_house(1);
  const Eigen::Vector2d point_m(walled.rooms[1].x_m, walled.rooms[1].y_m);
  sim::FloorGrid& grid = walled.occupied;
  for (int row = 0; row < grid.height; row += 10) {
    for (int column = 0; column < grid.width; column += 10) {
      grid.cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.width) +
                 static_cast<std::size_t>(column)] = 255;
    }
  }
  const auto pose = starting_pose(walled, point_m, robot_, 1);
  ASSERT_FALSE(pose);
  EXPECT_EQ(pose.error().code, ErrorCode::kInvalidInput);
}

INSTANTIATE_TEST_SUITE_P(Robots, StartingPose, ::testing::Bool(),
                         [](const auto& instance) { return instance.param ? "chair" : "disc"; });

TEST(FaultSchedule, KnowsWhatIsOn) {
  const FaultSchedule faults({{wire::FaultKind::kLinkLost, 2.0, 3.0, 1.0},
                              {wire::FaultKind::kCameraOccluded, 4.0, 1.0, 0.3},
                              {wire::FaultKind::kObstacle, 9.0}});
  EXPECT_FALSE(faults.active(wire::FaultKind::kLinkLost, 1.9));
  EXPECT_TRUE(faults.active(wire::FaultKind::kLinkLost, 2.0));
  EXPECT_FALSE(faults.active(wire::FaultKind::kLinkLost, 5.0));
  EXPECT_DOUBLE_EQ(faults.share(wire::FaultKind::kCameraOccluded, 4.5), 0.3);
  EXPECT_DOUBLE_EQ(faults.share(wire::FaultKind::kCameraOccluded, 5.5), 0.0);
  EXPECT_EQ(faults.began_s(1.0), std::nullopt);
  EXPECT_EQ(faults.began_s(3.0), 2.0);
  EXPECT_EQ(faults.began_s(4.2), 4.0);
  EXPECT_EQ(faults.began_s(8.0), std::nullopt) << "long over";
  EXPECT_TRUE(faults.active(wire::FaultKind::kObstacle, 1e6)) << "without an end it stays";
  EXPECT_DOUBLE_EQ(faults.ends_s(4.0), 5.0);
}

TEST(BoxAhead, StandsOneAndAHalfMetresAlongTheWay) {
  const auto box = box_ahead({0.0, 0.0, 0.0}, {{1.0, 0.0}, {1.0, 3.0}});
  ASSERT_TRUE(box);
  EXPECT_NEAR(box->pose.x_m, 1.0, 1e-9);
  EXPECT_NEAR(box->pose.y_m, 0.5, 0.06);
}

TEST(BoxAhead, IsNeverPutOnTheRobot) {
  const auto box = box_ahead({0.0, 0.0, 0.0}, {{0.8, 0.0}, {0.0, 0.1}, {3.0, 0.1}});
  ASSERT_TRUE(box);
  EXPECT_GE(std::hypot(box->pose.x_m, box->pose.y_m), 1.0);
  EXPECT_FALSE(box_ahead({0.0, 0.0, 0.0}, {{1.2, 0.0}}));
}

TEST(Bystander, SaysTheTruthOrYesOrNothing) {
  const Pose2 there{3.0, 4.0, 1.0};
  const auto says = [&](const char* name, const Pose2& robot) { return answers_named(name, there).value()(robot); };
  EXPECT_EQ(says("right", {3.3, 4.39, -1.0}), true) << "just within half a metre";
  EXPECT_EQ(says("right", {3.3, 4.41, 1.0}), false);
  EXPECT_EQ(says("yes", {30.0, 4.0, 1.0}), true);
  EXPECT_EQ(says("nobody", there), std::nullopt);
  EXPECT_FALSE(answers_named("wrong", there));
}

TEST(MissionPlan, TakesOverWhoAnswersAndHowFastItMayBe) {
  wire::ScenarioFile scenario;
  wire::ScenarioMission mission;
  mission.random = 2;
  mission.answers = "right";
  scenario.missions = {mission};
  scenario.speed_limit_mps = 0.3;
  for (const MissionPlan& plan : plan_missions(scenario, {"hall", "kitchen"})) {
    EXPECT_EQ(plan.answers, "right");
    EXPECT_EQ(plan.speed_limit_mps, 0.3);
  }
}

/// A robot in the generated offices.
class SimulatedDrive : public ::testing::Test {
 protected:
  SimulatedDrive() : world_(sim::generate_offices(1)) {
    sim::Irradiance even;  // light that costs nothing
    even.corners.setConstant(world_.fine_scene().vertices_m.rows(), 3, 0.6F);
    EXPECT_TRUE(world_.set_irradiance(sim::LightPreset::kDay, std::move(even)));
    SimulatedRobotConfig config;
    config.camera = homeward::testing::small_mirror_camera();
    auto robot = SimulatedRobot::create(world_, config, {2.0, 1.1, 0.0});
    robot_.emplace(std::move(*robot));
  }
  sim::LitWorld world_;
  std::optional<SimulatedRobot> robot_;
};

TEST_F(SimulatedDrive, WheelsThatSlipSayMoreThanTheRobotDrove) {
  robot_->command({0.4, 0.0});
  robot_->advance(2.0);
  const double sound_m = robot_->odometry().x_m;
  EXPECT_NEAR(sound_m, robot_->vehicle().path_m(), 0.03 * sound_m);
  robot_->slip(0.5);
  robot_->advance(4.0);
  robot_->slip(0.0);
  const double driven_m = robot_->vehicle().path_m() - sound_m;
  EXPECT_NEAR((robot_->odometry().x_m - sound_m) / driven_m, 2.0, 0.1);
  const Pose2 before = robot_->odometry();
  const double path_m = robot_->vehicle().path_m();
  robot_->advance(1.0);
  EXPECT_NEAR(robot_->odometry().x_m - before.x_m, robot_->vehicle().path_m() - path_m, 0.03) << "sound again";
}

TEST_F(SimulatedDrive, ABoxIsSeenMeasuredAndInTheWay) {
  const Image before = robot_->picture();
  EXPECT_GT(robot_->sweep().ranges_m.front(), 3.0F);
  robot_->set_boxes({sim::Box{{3.5, 1.1, 0.0}}});
  EXPECT_NEAR(robot_->sweep().ranges_m.front(), 1.25, 0.05);
  const Image after = robot_->picture();
  std::size_t changed = 0;
  for (std::size_t i = 0; i < after.data.size(); ++i)
    changed += std::abs(after.data[i] - before.data[i]) > 25 ? 1U : 0U;
  EXPECT_GT(changed, after.data.size() / 500) << "of " << after.data.size();
  robot_->command({0.4, 0.0});
  robot_->advance(6.0);
  EXPECT_EQ(robot_->vehicle().collisions(), 1);
  robot_->set_boxes({});
  EXPECT_GT(robot_->sweep().ranges_m.front(), 2.0F);
}

}  // namespace
}  // namespace homeward::scenario::scenario_parts_test
