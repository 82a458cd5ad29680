// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "contract/schema_library.hpp"
#include "wire/event_json.hpp"
#include "wire/map_info_json.hpp"
#include "wire/plan_json.hpp"
#include "wire/plan_pose_json.hpp"

namespace homeward::wire::plan_encoders_test {
namespace {

using homeward::testing::schemas;
using nlohmann::json;
using ::testing::IsEmpty;

PlanVersionView sample_version(std::int64_t version) {
  PlanVersionView view;
  view.version = version;
  view.format = "svg";
  view.by = "anna";
  view.bytes = 1200;
  view.metres_per_unit = 0.01;
  view.lines = 12;
  view.least_m = {-1.0, -2.0, 0.0};
  view.most_m = {9.0, 4.0, 2.5};
  return view;
}

TEST(PlanEncoders, WritePlansThatTheSchemaAccepts) {
  PlanView plan{PlanId("plan1"), "Ground floor", 7, {MapId("house")}, {sample_version(1), sample_version(2)}};
  plan.versions[1].up = PlanUp::kY;
  plan.versions[1].metres_per_unit = std::nullopt;
  const json value = plan_info_to_json(plan);
  EXPECT_THAT(schemas().problems("plan_info", value), IsEmpty());
  EXPECT_EQ(value["versions"][1]["version"], 2);
  EXPECT_EQ(value["versions"][1]["up"], "y");
  EXPECT_TRUE(value["versions"][0]["up"].is_null());
  EXPECT_TRUE(value["versions"][1]["metres_per_unit"].is_null());
  EXPECT_EQ(value["versions"][0]["extent"]["min_y_m"], -2.0);
}

TEST(PlanEncoders, WriteLinesToTheMillimetre) {
  const json value = plan_lines_to_json(PlanId("plan1"), 2, {{{0.1F, -0.12345F}, {4.2F, 3.0F}}}, 70);
  EXPECT_THAT(schemas().problems("plan_lines", value), IsEmpty());
  EXPECT_EQ(value["segments"][0], json::parse(R"({"x1_m":0.1,"y1_m":-0.123,"x2_m":4.2,"y2_m":3.0})"));
  EXPECT_EQ(value["total"], 70);
}

TEST(PlanEncoders, WriteMapsOnPlansThatTheSchemaAccepts) {
  MapPlanView view{MapId("house"), 4, PlanId("plan1"), 1, 2, 9, "anna", {}, {}};
  EXPECT_THAT(schemas().problems("map_plan", map_plan_to_json(view)), IsEmpty()) << "nothing is placed";
  view.pins = {{ImageId("t/1.jpg"), {1.0, 2.0}, 0.5}, {ImageId("t/2.jpg"), {3.0, 2.0}, std::nullopt}};
  view.on_plan.pin_places = {PlaceId("p1"), std::nullopt};
  view.on_plan.places = {{PlaceId("p1"), {1.0, 2.0, 0.5}, true, 0.25}, {PlaceId("p2"), {4.0, 2.0, 0.0}, false, {}}};
  view.on_plan.unplaced = {PlaceId("p9")};
  view.on_plan.rms_m = 0.25;
  const json value = map_plan_to_json(view);
  EXPECT_THAT(schemas().problems("map_plan", value), IsEmpty());
  EXPECT_EQ(value["pins"][0]["place"], "p1");
  EXPECT_TRUE(value["pins"][1]["place"].is_null());
  EXPECT_TRUE(value["places"][1]["residual_m"].is_null());
}

TEST(PlanEncoders, SayToWhichPlanAMapIsTied) {
  MapInfoView map{MapId("house"), "House", MapState::kReady, 1, 2, 3, {TourId("t1")}, "hw2"};
  EXPECT_TRUE(map_info_to_json(map)["plan"].is_null());
  map.plan = MapPlanInfo{PlanId("plan1"), 2, 9};
  const json value = map_info_to_json(map);
  EXPECT_THAT(schemas().problems("map_info", value), IsEmpty());
  EXPECT_EQ(value["plan"], json::parse(R"({"id":"plan1","version":2,"tied_us":9})"));
}

TEST(PlanPins, ComeBackAsTheyWereKept) {
  const std::vector<map::PlanPin> pins = {{ImageId("t/1.jpg"), {1.0, 2.0}, 0.5},
                                          {ImageId("t/2.jpg"), {3.0, -2.0}, std::nullopt}};
  const auto back = plan_pins_from_json(plan_pins_to_json(pins), "pins");
  ASSERT_TRUE(back) << back.error().message;
  ASSERT_EQ(back->size(), 2U);
  EXPECT_EQ((*back)[0].image, ImageId("t/1.jpg"));
  EXPECT_EQ((*back)[0].theta_rad, 0.5);
  EXPECT_EQ((*back)[1].position_m, Eigen::Vector2d(3.0, -2.0));
  EXPECT_FALSE((*back)[1].theta_rad);
  EXPECT_EQ(plan_pins_from_json(json::parse(R"([{"image":"t/1.jpg","x_m":1}])"), "pins").error().where, "pins/0/y_m");
  EXPECT_FALSE(plan_pins_from_json(json::object(), "pins"));
}

TEST(PlanEncoders, WritePosesOnPlansThatTheSchemaAccepts) {
  PlanPoseView view;
  view.robot = RobotId("r1");
  view.map = MapId("house");
  view.plan = PlanId("plan1");
  view.pose = {1.25, -2.5, 0.75};
  view.spread_m = 0.125;
  view.place = PlaceId("p1");
  view.word = PlaceOnPlan::kImpossible;
  view.lines_expected = 31;
  view.lines_confirmed = 24;
  view.particles.assign(kMaxPlanParticles, Pose2{1.2345, -2.5, 3.14159});
  const json known = plan_pose_to_json(view);
  EXPECT_THAT(schemas().problems("plan_pose", known), IsEmpty());
  EXPECT_EQ(known["x_m"], 1.25);
  EXPECT_EQ(known["word"], "impossible");
  EXPECT_EQ(known["particles"][0], json::parse(R"({"x_m":1.23,"y_m":-2.5,"theta_rad":3.14})"));
  view.place.reset();
  view.word = PlaceOnPlan::kSilent;
  for (const PlanLoss loss : {PlanLoss::kSearching, PlanLoss::kAmbiguous, PlanLoss::kNotInPlan}) {
    view.lost = loss;
    const json lost = plan_pose_to_json(view);
    EXPECT_THAT(schemas().problems("plan_pose", lost), IsEmpty());
    EXPECT_TRUE(lost["x_m"].is_null() && lost["theta_rad"].is_null() && lost["spread_m"].is_null());
  }
  view.lost.reset();
  const json kept = mission_plan_to_json(MissionId("m1"), {view, view});
  EXPECT_THAT(schemas().problems("mission_plan", kept), IsEmpty());
  EXPECT_EQ(kept["poses"].size(), 2U);
  const json event = event_to_json(PlanPoseTold{std::make_shared<const PlanPoseView>(view)}, 7);
  EXPECT_THAT(schemas().problems("event", event), IsEmpty());
}

}  // namespace
}  // namespace homeward::wire::plan_encoders_test
