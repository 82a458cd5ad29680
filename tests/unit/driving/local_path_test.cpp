// SPDX-License-Identifier: Apache-2.0
#include "driving/local_path.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/angles.hpp"

namespace homeward::driving::local_path_test {
namespace {

using Points = std::vector<Eigen::Vector2d>;

void add_wall(Points& points, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const int count = static_cast<int>((to - from).norm() / 0.03);
  for (int i = 0; i <= count; ++i) points.emplace_back(from + (to - from) * i / std::max(1, count));
}

TEST(LocalWay, IsStraightWhereNothingStands) {
  const auto way = local_way({}, {}, {2.0, 0.0});
  ASSERT_TRUE(way);
  EXPECT_TRUE(way->reaches_goal);
  EXPECT_NEAR(way->length_m, 2.0, 0.1);
  EXPECT_GT(way->carrot_m.x(), 0.4);
  EXPECT_NEAR(way->carrot_m.y(), 0.0, 1e-9);
}

TEST(LocalWay, GoesThroughADoorBesideTheStraightLine) {
  Points points;  // a wall 1.2 m ahead with a door of 1 m whose middle lies 1 m to the left
  add_wall(points, {1.2, -3.0}, {1.2, 0.5});
  add_wall(points, {1.2, 1.5}, {1.2, 3.0});
  const auto way = local_way({}, points, {2.4, 0.0});
  ASSERT_TRUE(way);
  EXPECT_TRUE(way->reaches_goal);
  EXPECT_GT(way->length_m, 2.6);
  EXPECT_LT(way->length_m, 4.0);
  EXPECT_GT(way->carrot_m.y(), 0.2);  // first to the left
}

TEST(LocalWay, TakesNoDoorThatIsTooNarrow) {
  Points points;  // 0.7 m wide is too little for 0.35 m of radius and the room beside it
  add_wall(points, {1.2, -3.1}, {1.2, 0.65});
  add_wall(points, {1.2, 1.35}, {1.2, 3.1});
  const auto way = local_way({}, points, {2.4, 0.0});
  ASSERT_TRUE(way);
  EXPECT_FALSE(way->reaches_goal);
  EXPECT_LT(way->carrot_m.x(), 1.2 - 0.35);
}

TEST(LocalWay, GoesRoundAWallItStandsBefore) {
  Points points;
  add_wall(points, {0.9, -0.6}, {0.9, 0.9});
  const auto way = local_way({}, points, {1.8, 0.0});
  ASSERT_TRUE(way);
  EXPECT_TRUE(way->reaches_goal);
  EXPECT_LT(way->carrot_m.y(), 0.0);  // the shorter way round is to the right
}

TEST(LocalWay, IsNothingWhenWalledIn) {
  Points points;
  for (int i = 0; i < 120; ++i) {
    points.emplace_back(0.46 * std::cos(2.0 * kPi * i / 120.0), 0.46 * std::sin(2.0 * kPi * i / 120.0));
  }
  EXPECT_FALSE(local_way({}, points, {2.0, 0.0}));
}

TEST(LocalWay, LeavesAPlaceThatIsTooNearAWall) {
  Points points;
  add_wall(points, {-2.0, 0.37}, {2.0, 0.37});  // 2 cm beside the body
  const auto way = local_way({}, points, {1.5, -0.8});
  ASSERT_TRUE(way);
  EXPECT_TRUE(way->reaches_goal);
  EXPECT_LT(way->carrot_m.y(), 0.0);
}

TEST(LocalWay, DrawsAFarGoalToItsBorder) {
  const auto way = local_way({}, {}, {0.0, -40.0});
  ASSERT_TRUE(way);
  EXPECT_TRUE(way->reaches_goal);
  EXPECT_NEAR(way->carrot_m.x(), 0.0, 1e-9);
  EXPECT_LT(way->carrot_m.y(), -0.4);
}

TEST(LocalWay, KeepsToTheMiddleOfADoor) {
  Points points;  // a door of 1.2 m from y = -0.2 to y = 1; the straight line to the goal would graze its post
  add_wall(points, {0.5, -3.0}, {0.5, -0.2});
  add_wall(points, {0.5, 1.0}, {0.5, 3.0});
  const auto way = local_way({}, points, {1.6, 0.0});
  ASSERT_TRUE(way);
  ASSERT_TRUE(way->reaches_goal);
  EXPECT_GT(way->carrot_m.y(), 0.2);
}

}  // namespace
}  // namespace homeward::driving::local_path_test
