// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "unit/db/store_fixture.hpp"

namespace homeward::db::store_plan_poses_test {
namespace {

class StorePlanPoses : public StoreTest {
 protected:
  RobotId new_robot() {
    RobotRecord robot;
    robot.name = "chair";
    return store().add_robot(robot)->id;
  }
  MissionId new_mission(const RobotId& robot) {
    wire::MissionView mission;
    mission.robot = robot;
    mission.map = MapId("house");
    return store().add_mission(mission)->id;
  }
  static wire::PlanPoseView said(TimeUs t_us) {
    wire::PlanPoseView pose;
    pose.plan = wire::PlanId("plan1");
    pose.version = 2;
    pose.t_us = t_us;
    pose.pose = {1.5, -2.25, 0.5};
    pose.spread_m = 0.125;
    pose.place = PlaceId("p2");
    pose.word = wire::PlaceOnPlan::kImpossible;
    pose.lines_expected = 31;
    pose.lines_confirmed = 24;
    return pose;
  }
};

TEST_F(StorePlanPoses, OutliveTheProgramInTheOrderOfThePictures) {
  const RobotId robot = new_robot();
  const MissionId mission = new_mission(robot);
  EXPECT_TRUE(store().plan_poses(mission)->empty());
  wire::PlanPoseView lost = said(5);
  lost.lost = wire::PlanLoss::kAmbiguous;
  lost.place.reset();
  lost.word = wire::PlaceOnPlan::kSilent;
  ASSERT_TRUE(store().add_plan_poses(mission, {said(7), lost}));
  ASSERT_TRUE(store().add_plan_poses(mission, {said(6)}));
  open();
  const auto kept = store().plan_poses(mission).value();
  ASSERT_EQ(kept.size(), 3U);
  EXPECT_EQ(kept[0].t_us, 5);
  EXPECT_EQ(kept[0].lost, wire::PlanLoss::kAmbiguous);
  EXPECT_FALSE(kept[0].place);
  EXPECT_EQ(kept[0].word, wire::PlaceOnPlan::kSilent);
  EXPECT_EQ(kept[1].t_us, 6);
  const wire::PlanPoseView& last = kept[2];
  EXPECT_EQ(last.robot, robot);
  EXPECT_EQ(last.map, MapId("house"));
  EXPECT_EQ(last.plan, wire::PlanId("plan1"));
  EXPECT_EQ(last.version, 2);
  EXPECT_FALSE(last.lost);
  EXPECT_EQ(last.pose.x_m, 1.5);
  EXPECT_EQ(last.pose.y_m, -2.25);
  EXPECT_EQ(last.pose.theta_rad, 0.5);
  EXPECT_EQ(last.spread_m, 0.125);
  EXPECT_EQ(last.place, PlaceId("p2"));
  EXPECT_EQ(last.word, wire::PlaceOnPlan::kImpossible);
  EXPECT_EQ(last.lines_expected, 31);
  EXPECT_EQ(last.lines_confirmed, 24);
}

TEST_F(StorePlanPoses, AreOfAMissionThatIsThereAndGoWithIt) {
  EXPECT_EQ(store().add_plan_poses(MissionId("none"), {said(1)}).error().code, ErrorCode::kNotFound);
  const RobotId robot = new_robot();
  const MissionId mission = new_mission(robot);
  const MissionId other = new_mission(robot);
  ASSERT_TRUE(store().add_plan_poses(mission, {said(1)}));
  EXPECT_TRUE(store().plan_poses(other)->empty());
  ASSERT_TRUE(store().remove_robot(robot));
  EXPECT_TRUE(store().plan_poses(mission)->empty());
  open();  // whose tables are summed up
  EXPECT_TRUE(store().plan_poses(mission)->empty());
}

TEST_F(StorePlanPoses, AreNoMoreThanAMissionMayHave) {
  const MissionId mission = new_mission(new_robot());
  std::vector<wire::PlanPoseView> many;
  for (std::size_t i = 0; i < wire::kMaxMissionPlanPoses - 1; ++i) many.push_back(said(static_cast<TimeUs>(i)));
  ASSERT_TRUE(store().add_plan_poses(mission, many));
  const auto end = static_cast<TimeUs>(wire::kMaxMissionPlanPoses);
  ASSERT_TRUE(store().add_plan_poses(mission, {said(end), said(end + 1)}));
  ASSERT_TRUE(store().add_plan_poses(mission, {said(end + 2)}));
  const auto kept = store().plan_poses(mission).value();
  ASSERT_EQ(kept.size(), wire::kMaxMissionPlanPoses);
  EXPECT_EQ(kept.back().t_us, end);
}

}  // namespace
}  // namespace homeward::db::store_plan_poses_test
