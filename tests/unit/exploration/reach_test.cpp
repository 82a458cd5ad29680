// SPDX-License-Identifier: Apache-2.0
#include "exploration/reach.hpp"

#include <gtest/gtest.h>

#include "support/drawn_walls.hpp"

namespace homeward::exploration {
namespace {

ExploredFloor seen_from(const std::vector<Pose2>& poses) {
  ExploredFloor floor;
  for (const Pose2& pose : poses) {
    const RangeSweep sweep = sweep_of(testing::two_rooms(), pose);
    floor.see(sweep, geometry::surface_of(sweep), pose);
  }
  return floor;
}

std::size_t cell(const Reach& reach, double x_m, double y_m) {
  return reach.frame().index(reach.frame().cell({x_m, y_m}));
}

TEST(ReachTest, ItGoesThroughADoorThatTheBodyFitsAndKeepsOffTheWalls) {
  const ExploredFloor floor = seen_from({{2.0, 2.0, 0.1}, {4.5, 2.0, 0.2}, {7.0, 2.5, 0.0}});
  const Reach reach = Reach::from(floor, {1.0, 2.0}, {});
  ASSERT_TRUE(reach.reaches(cell(reach, 7.0, 2.5)));
  EXPECT_FALSE(reach.reaches(cell(reach, 1.0, 0.2))) << "nearer to the wall than its radius";
  const auto way_m = reach.way_m(cell(reach, 7.0, 2.5));
  ASSERT_GT(way_m.size(), 50U);
  EXPECT_LT((way_m.front() - Eigen::Vector2d(1.0, 2.0)).norm(), 0.1);
  for (const Eigen::Vector2d& point : way_m) {
    if (std::abs(point.x() - 5.0) >= 0.1) continue;
    EXPECT_NEAR(point.y(), 2.0, 0.12) << "through the middle of the door";
  }
}

TEST(ReachTest, AWideBodyDoesNotFitThroughTheDoor) {
  const ExploredFloor floor = seen_from({{2.0, 2.0, 0.1}, {4.5, 2.0, 0.2}, {7.0, 2.5, 0.0}});
  ReachConfig wide;
  wide.radius_m = 0.55;
  const Reach reach = Reach::from(floor, {1.5, 2.0}, wide);
  EXPECT_FALSE(reach.reaches(cell(reach, 7.0, 2.5)));
  EXPECT_TRUE(reach.way_m(cell(reach, 7.0, 2.5)).empty());
}

TEST(ReachTest, WhatIsBarredIsNotDriven) {
  const ExploredFloor floor = seen_from({{2.0, 2.0, 0.1}, {4.5, 2.0, 0.2}, {7.0, 2.5, 0.0}});
  std::vector<std::uint8_t> barred(floor.frame().size(), 0);
  for (std::size_t i = 0; i < barred.size(); ++i)
    barred[i] = std::abs(floor.frame().centre_m(floor.frame().cell_at(i)).x() - 5.0) < 0.1;
  const Reach reach = Reach::from(floor, {1.0, 2.0}, {}, &barred);
  EXPECT_FALSE(reach.reaches(cell(reach, 7.0, 2.5)));
}

TEST(ReachTest, FromWhereNothingIsKnownItReachesNothing) {
  const ExploredFloor floor = seen_from({{2.0, 2.0, 0.1}});
  const Reach reach = Reach::from(floor, {2.0, -1.5}, {});
  for (std::size_t i = 0; i < floor.frame().size(); ++i) ASSERT_FALSE(reach.reaches(i));
}

}  // namespace
}  // namespace homeward::exploration
