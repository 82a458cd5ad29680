// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "support/sample_map.hpp"
#include "unit/db/store_fixture.hpp"

namespace homeward::db::store_plans_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using wire::PlanId;

class StorePlans : public StoreTest {
 protected:
  static wire::PlanVersionView version() {
    wire::PlanVersionView one;
    one.format = "svg";
    one.created_us = 7;
    one.by = "anna";
    one.metres_per_unit = 0.01;
    one.up = wire::PlanUp::kY;
    one.wall_height_m = 2.75;
    one.lines = 4;
    one.triangles = 8;
    one.least_m = {-1.0, -2.0, 0.0};
    one.most_m = {9.0, 4.0, 2.75};
    return one;
  }
  wire::PlanView uploaded(const std::string& name = "ground floor", TimeUs created_us = 5) {
    wire::PlanView plan;
    plan.name = name;
    plan.created_us = created_us;
    plan.versions = {version()};
    return store().add_plan(plan, file_).value();
  }
  MapId new_map() {
    MapRecord map;
    map.name = "house";
    return store().add_map(map)->id;
  }
  static MapPlanRecord tie(const MapId& map, const PlanId& plan, std::int64_t version = 1) {
    return {map, plan, version, 11, "anna", {{ImageId("t/1.jpg"), {1.0, 2.0}, 0.5}, {ImageId("t/9.jpg"), {3, 4}, {}}}};
  }
  const std::vector<std::uint8_t> file_ = {'<', 's', 'v', 'g', 0, 255};
};

TEST_F(StorePlans, OutliveTheProgram) {
  const PlanId id = uploaded().id;
  open();
  const wire::PlanView plan = store().plan(id).value();
  EXPECT_EQ(plan.name, "ground floor");
  EXPECT_EQ(plan.created_us, 5);
  ASSERT_EQ(plan.versions.size(), 1U);
  const wire::PlanVersionView& one = plan.versions[0];
  EXPECT_EQ(one.version, 1);
  EXPECT_EQ(one.format, "svg");
  EXPECT_EQ(one.by, "anna");
  EXPECT_EQ(one.bytes, 6);
  EXPECT_EQ(one.metres_per_unit, 0.01);
  EXPECT_EQ(one.up, wire::PlanUp::kY);
  EXPECT_EQ(one.wall_height_m, 2.75);
  EXPECT_EQ(one.lines, 4);
  EXPECT_EQ(one.triangles, 8);
  EXPECT_EQ(one.least_m, Eigen::Vector3d(-1.0, -2.0, 0.0));
  EXPECT_EQ(one.most_m, Eigen::Vector3d(9.0, 4.0, 2.75));
  EXPECT_EQ(store().plan_file(id, 1).value(), file_);
}

TEST_F(StorePlans, AreListedAsTheyCame) {
  const PlanId second = uploaded("first floor", 9).id;
  const PlanId first = uploaded("ground floor", 3).id;
  const auto plans = store().plans().value();
  ASSERT_EQ(plans.size(), 2U);
  EXPECT_EQ(plans[0].id, first);
  EXPECT_EQ(plans[1].id, second);
}

TEST_F(StorePlans, KeepEveryVersionAsItWasUploaded) {
  const PlanId id = uploaded().id;
  const std::vector<std::uint8_t> other = {'#', 'V'};
  wire::PlanVersionView next = version();
  next.format = "wrl";
  next.metres_per_unit = std::nullopt;
  next.up = std::nullopt;
  ASSERT_EQ(store().add_plan_version(id, next, other)->versions.size(), 2U);
  open();
  const wire::PlanView plan = store().plan(id).value();
  EXPECT_EQ(plan.versions[1].version, 2);
  EXPECT_EQ(plan.versions[1].format, "wrl");
  EXPECT_FALSE(plan.versions[1].metres_per_unit);
  EXPECT_FALSE(plan.versions[1].up);
  EXPECT_EQ(store().plan_file(id, 1).value(), file_);
  EXPECT_EQ(store().plan_file(id, 2).value(), other);
  EXPECT_EQ(store().plan_file(id, 3).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(store().add_plan_version(PlanId("none"), next, other).error().code, ErrorCode::kNotFound);
}

TEST_F(StorePlans, TakeNoMoreThanSoManyVersions) {
  const PlanId id = uploaded().id;
  for (std::size_t i = 1; i < wire::kMaxPlanVersions; ++i)
    ASSERT_TRUE(store().add_plan_version(id, version(), file_)) << i;
  EXPECT_EQ(store().add_plan_version(id, version(), file_).error().code, ErrorCode::kConflict);
}

TEST_F(StorePlans, TakeAnotherName) {
  const PlanId id = uploaded().id;
  EXPECT_EQ(store().rename_plan(id, "annex")->name, "annex");
  open();
  EXPECT_EQ(store().plan(id)->name, "annex");
  EXPECT_EQ(store().rename_plan(PlanId("none"), "annex").error().code, ErrorCode::kNotFound);
}

TEST_F(StorePlans, AreTiedToMapsByPictures) {
  const PlanId id = uploaded().id;
  const MapId map = new_map();
  EXPECT_FALSE(store().map(map)->plan);
  EXPECT_EQ(store().map_plan(map).error().code, ErrorCode::kNotFound);
  ASSERT_TRUE(store().tie_map(tie(map, id)));
  open();
  const MapPlanRecord kept = store().map_plan(map).value();
  EXPECT_EQ(kept.plan, id);
  EXPECT_EQ(kept.version, 1);
  EXPECT_EQ(kept.tied_us, 11);
  EXPECT_EQ(kept.author, "anna");
  ASSERT_EQ(kept.pins.size(), 2U);
  EXPECT_EQ(kept.pins[0].image, ImageId("t/1.jpg"));
  EXPECT_EQ(kept.pins[0].position_m, Eigen::Vector2d(1.0, 2.0));
  EXPECT_EQ(kept.pins[0].theta_rad, 0.5);
  EXPECT_FALSE(kept.pins[1].theta_rad);
  EXPECT_THAT(store().plan(id)->maps, ElementsAre(map));
  EXPECT_EQ(store().map(map)->plan->plan, id);
  EXPECT_EQ(store().maps()->at(0).plan->tied_us, 11);
}

TEST_F(StorePlans, AreTiedAnewAndUntied) {
  const PlanId id = uploaded().id;
  const MapId map = new_map();
  ASSERT_TRUE(store().tie_map(tie(map, id)));
  MapPlanRecord other = tie(map, id);
  other.pins.pop_back();
  ASSERT_TRUE(store().tie_map(other));
  EXPECT_EQ(store().map_plan(map)->pins.size(), 1U);
  ASSERT_TRUE(store().untie_map(map));
  ASSERT_TRUE(store().untie_map(map)) << "it is tied to none";
  EXPECT_THAT(store().plan(id)->maps, IsEmpty());
  EXPECT_EQ(store().untie_map(MapId("none")).error().code, ErrorCode::kNotFound);
}

TEST_F(StorePlans, AreNotTiedToWhatIsNotThere) {
  const PlanId id = uploaded().id;
  const MapId map = new_map();
  EXPECT_EQ(store().tie_map(tie(MapId("none"), id)).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(store().tie_map(tie(map, PlanId("none"))).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(store().tie_map(tie(map, id, 2)).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(store().map_plan(map).error().code, ErrorCode::kNotFound);
}

TEST_F(StorePlans, StayWhileAMapIsTiedToThem) {
  const PlanId id = uploaded().id;
  const MapId map = new_map();
  ASSERT_TRUE(store().tie_map(tie(map, id)));
  EXPECT_EQ(store().remove_plan(id).error().code, ErrorCode::kConflict);
  ASSERT_TRUE(store().remove_map(map));
  ASSERT_TRUE(store().remove_plan(id)) << "its tie went with the map";
  EXPECT_EQ(store().remove_plan(id).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(store().plan_file(id, 1).error().code, ErrorCode::kNotFound);
  open();
  EXPECT_THAT(store().plans().value(), IsEmpty());
}

TEST_F(StorePlans, StayTiedWhenTheMapHasNewContents) {
  const PlanId id = uploaded().id;
  const MapId map = new_map();
  ASSERT_TRUE(store().tie_map(tie(map, id)));
  map::TopologicalMap contents = homeward::testing::sample_map();
  contents.revision = 1;
  ASSERT_TRUE(store().save_map_contents(map, contents, {}, 0));
  EXPECT_EQ(store().map_plan(map)->pins.size(), 2U);
}

}  // namespace
}  // namespace homeward::db::store_plans_test
