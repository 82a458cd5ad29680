// SPDX-License-Identifier: Apache-2.0
#include "linemodel/plan_floor.hpp"

#include <gtest/gtest.h>

#include "support/shaded_room.hpp"

namespace homeward::linemodel {
namespace {

TEST(PlanSlice, MeasuresTheWayToWhatStandsAtItsHeight) {
  const PlanSlice low(two_rooms(), 0.28, 0.32);
  EXPECT_NEAR(low.clearance_m({3.9, 1.7}), 1.0, 0.06) << "to the table";
  EXPECT_NEAR(low.clearance_m({2.1, 3.5}), 0.5, 0.06) << "under the shelf, to the wall";
  const PlanSlice high(two_rooms(), 1.6, 1.9);
  EXPECT_NEAR(high.clearance_m({3.9, 1.7}), 1.7, 0.06) << "over the table, to the wall";
  EXPECT_EQ(low.clearance_m({-5.0, 1.0}), 0.0F);
  EXPECT_FALSE(low.covers({-5.0, 1.0}));
  EXPECT_TRUE(low.covers({2.0, 2.0}));
}

TEST(PlanFloor, IsFreeIndoorsOffWalls) {
  const PlanFloor floor = PlanFloor::of(two_rooms()).value();
  EXPECT_TRUE(floor.free({2.0, 2.0}));
  EXPECT_TRUE(floor.free({6.1, 3.1})) << "the doorway";
  EXPECT_TRUE(floor.free({3.9, 0.4})) << "where the plan has a table, which may have been moved";
  EXPECT_FALSE(floor.free({6.1, 1.5})) << "a wall";
  EXPECT_FALSE(floor.free({0.3, 0.7})) << "a wardrobe";
  EXPECT_FALSE(floor.free({20.0, 1.0}));
  for (const Eigen::Vector2d& point_m : floor.free_points_m()) EXPECT_TRUE(floor.free(point_m));
  EXPECT_NEAR(static_cast<double>(floor.free_points_m().size()) * 0.0625, 42.0, 6.0) << "square metres";
}

TEST(PlanFloor, IsWhatWallsEncloseWhereNoFloorIsDrawn) {
  MeshOfBoxes walls;
  walls.box({0.0F, 0.0F, 0.0F}, {5.0F, 0.1F, 2.5F});
  walls.box({0.0F, 4.0F, 0.0F}, {5.0F, 4.1F, 2.5F});
  walls.box({0.0F, 0.0F, 0.0F}, {0.1F, 4.0F, 2.5F});
  walls.box({4.9F, 0.0F, 0.0F}, {5.0F, 4.0F, 2.5F});
  walls.box({7.0F, 0.0F, 0.0F}, {7.1F, 4.0F, 2.5F});  // stands outside
  const PlanFloor floor = PlanFloor::of(plan_of_mesh(walls.vertices_m(), walls.triangles())).value();
  EXPECT_TRUE(floor.free({2.5, 2.0}));
  EXPECT_FALSE(floor.free({6.0, 2.0}));
}

TEST(PlanFloor, RefusesAPlanThatIsNotInMetres) {
  Plan plan = two_rooms();
  plan.vertices_m *= 1000.0F;
  const auto floor = PlanFloor::of(plan);
  ASSERT_FALSE(floor);
  EXPECT_EQ(floor.error().code, ErrorCode::kInvalidInput);
}

}  // namespace
}  // namespace homeward::linemodel
