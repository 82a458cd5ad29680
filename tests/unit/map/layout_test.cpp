// SPDX-License-Identifier: Apache-2.0
#include "map/layout.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "map/lookup.hpp"
#include "support/ascii_map.hpp"

namespace homeward::map::layout_test {
namespace {

double apart(const std::vector<Eigen::Vector2d>& at, std::size_t a, std::size_t b) { return (at[a] - at[b]).norm(); }

void expect_inside(const std::vector<Eigen::Vector2d>& at) {
  for (const Eigen::Vector2d& position : at) {
    EXPECT_GE(position.minCoeff(), 0.0);
    EXPECT_LE(position.maxCoeff(), 1.0);
  }
}

TEST(Layout, DrawsASquareRoundFromBearingsAndTurns) {
  // Four places at the corners of a square of 2 m, the robot turning left at each.
  TopologicalMap map = testing::ascii_map("A B C D");
  for (int i = 0; i < 4; ++i) {
    Edge edge;
    edge.from = map.places[static_cast<std::size_t>(i)].id;
    edge.to = map.places[static_cast<std::size_t>((i + 1) % 4)].id;
    edge.bearing_rad = 0.0;
    edge.turn_rad = kPi / 2.0;
    edge.length_m = 2.0;
    map.edges.push_back(edge);
  }
  const auto at = layout(map);
  ASSERT_EQ(at.size(), 4U);
  expect_inside(at);
  const double side = apart(at, 0, 1);
  EXPECT_NEAR(side, 1.0, 0.02);  // fills the unit square
  EXPECT_NEAR(apart(at, 1, 2), side, 0.02);
  EXPECT_NEAR(apart(at, 2, 3), side, 0.02);
  EXPECT_NEAR(apart(at, 3, 0), side, 0.02);
  EXPECT_NEAR(apart(at, 0, 2), side * std::sqrt(2.0), 0.03);
  // Left turns run counter-clockwise on a floor plan: C lies above A, which is a smaller y on the screen.
  EXPECT_LT(at[2].y(), at[0].y());
}

TEST(Layout, FollowsOdometryWhereTheTourHasIt) {
  TopologicalMap map = testing::ascii_map("A-B-C");
  map.images[0].odometry = Pose2{0.0, 0.0, 0.0};
  map.images[1].odometry = Pose2{4.0, 0.0, kPi / 2.0};
  map.images[2].odometry = Pose2{4.0, 4.0, 0.0};
  const auto at = layout(map);
  expect_inside(at);
  EXPECT_NEAR(apart(at, 0, 1), apart(at, 1, 2), 0.02);
  EXPECT_NEAR(apart(at, 0, 2), apart(at, 0, 1) * std::sqrt(2.0), 0.03);
}

TEST(Layout, PutsComponentsSideBySide) {
  const auto at = layout(testing::ascii_map("A-B C-D"));
  expect_inside(at);
  EXPECT_LT(std::max(at[0].x(), at[1].x()), std::min(at[2].x(), at[3].x()));
}

TEST(Layout, DrawsDistinctPlacesApartWhenNothingIsKnown) {
  const auto at = layout(testing::ascii_map("A-B\n|  \nC-D"));
  expect_inside(at);
  for (std::size_t i = 0; i < at.size(); ++i) {
    for (std::size_t j = i + 1; j < at.size(); ++j) EXPECT_GT(apart(at, i, j), 0.05) << i << " " << j;
  }
}

TEST(Layout, IsEmptyForAnEmptyMapAndInsideForOnePlace) {
  EXPECT_TRUE(layout(TopologicalMap{}).empty());
  expect_inside(layout(testing::ascii_map("A")));
}

}  // namespace
}  // namespace homeward::map::layout_test
