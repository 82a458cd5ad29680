// SPDX-License-Identifier: Apache-2.0
#include "mapping/doorways.hpp"

#include <gtest/gtest.h>

#include "geometry/sweep_surface.hpp"
#include "support/drawn_walls.hpp"

namespace homeward::mapping {
namespace {

using Points = std::vector<Eigen::Vector2d>;

/// What sweeps hit that were taken at these spots.
Points hits_of(const std::vector<testing::DrawnWall>& walls, const Points& spots_m) {
  Points hits_m;
  for (const Eigen::Vector2d& spot : spots_m) {
    const Pose2 pose{spot.x(), spot.y(), 0.4};
    for (const auto& point : geometry::surface_of(sweep_of(walls, pose)))
      hits_m.push_back(position_m(pose * Pose2{point.at_m.x(), point.at_m.y(), 0.0}));
  }
  return hits_m;
}

std::vector<Doorway> found_in(const std::vector<testing::DrawnWall>& walls, const Points& spots_m) {
  return doorways_between(hits_of(walls, spots_m), spots_m);
}

TEST(DoorwaysTest, ADoorBetweenTwoSpotsIsFoundWhereItsWallIs) {
  const auto doorways = found_in(testing::two_rooms(), {{4.7, 2.1}, {5.25, 1.9}});
  ASSERT_EQ(doorways.size(), 1U);
  EXPECT_NEAR(doorways[0].middle_m.x(), 5.0, 0.04);
  EXPECT_NEAR(doorways[0].middle_m.y(), 2.0, 0.1);
  EXPECT_GT(std::abs(doorways[0].normal.x()), 0.99);
  EXPECT_NEAR(doorways[0].width_m, 1.0, 0.05);
}

TEST(DoorwaysTest, TheMiddleOfAThickWallCounts) {
  std::vector<testing::DrawnWall> walls;
  add_box(walls, 0.0, 0.0, 10.0, 4.0);
  add_box(walls, 4.9, 0.0, 5.1, 1.5);
  add_box(walls, 4.9, 2.5, 5.1, 4.0);
  const auto doorways = found_in(walls, {{4.5, 2.1}, {5.4, 1.9}});
  ASSERT_EQ(doorways.size(), 1U);
  EXPECT_NEAR(doorways[0].middle_m.x(), 5.0, 0.04);
}

TEST(DoorwaysTest, BesideADoorThereIsNone) {
  EXPECT_TRUE(found_in(testing::two_rooms(), {{4.2, 1.0}, {4.2, 3.0}}).empty());
  EXPECT_TRUE(found_in(testing::two_rooms(), {{3.0, 2.0}, {4.0, 2.0}}).empty());
}

TEST(DoorwaysTest, ANarrowCorridorIsNone) {
  std::vector<testing::DrawnWall> walls;
  add_box(walls, 0.0, 0.0, 8.0, 1.2);
  EXPECT_TRUE(found_in(walls, {{3.0, 0.6}, {3.5, 0.6}, {4.2, 0.7}}).empty());
}

TEST(DoorwaysTest, AWayBetweenATableAndAWallIsNone) {
  std::vector<testing::DrawnWall> walls;
  add_box(walls, 0.0, 0.0, 6.0, 6.0);
  add_box(walls, 2.0, 1.2, 3.5, 2.6);
  EXPECT_TRUE(found_in(walls, {{1.5, 0.6}, {2.2, 0.6}, {2.8, 0.6}, {3.4, 0.6}, {4.0, 0.7}}).empty());
}

TEST(DoorwaysTest, WithoutHitsOrSpotsThereIsNone) {
  EXPECT_TRUE(doorways_between({}, {}).empty());
  EXPECT_TRUE(doorways_between({}, Points{{0.0, 0.0}, {1.0, 0.0}}).empty());
  EXPECT_TRUE(doorways_between(hits_of(testing::two_rooms(), {{4.5, 2.0}}), Points{{4.5, 2.0}}).empty());
}

}  // namespace
}  // namespace homeward::mapping
