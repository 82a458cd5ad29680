// SPDX-License-Identifier: Apache-2.0
#include "sim/way_beside.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/floor.hpp"
#include "sim/generate/worlds.hpp"
#include "sim/tour_path.hpp"

namespace homeward::sim::way_beside_test {
namespace {

using Eigen::Vector2d;

/// A floor of 10 m by 4 m around y = 0, its cells 5 cm wide.
FloorGrid hall() {
  FloorGrid grid;
  grid.width = 200;
  grid.height = 80;
  grid.origin_m = {0.0, -2.0};
  grid.cells.assign(200U * 80U, 255);
  return grid;
}

void shut(FloorGrid& grid, const Vector2d& least_m, const Vector2d& most_m) {
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      const Vector2d point_m = centre_of(grid, {column, row});
      if ((point_m.array() < least_m.array()).any() || (point_m.array() > most_m.array()).any()) continue;
      grid.cells[static_cast<std::size_t>(row * grid.width + column)] = 0;
    }
  }
}

const std::vector<Vector2d> kStraight_m = {{0.5, 0.0}, {9.5, 0.0}};

TEST(WayBeside, RunsAsFarBesideAsAskedOnOpenFloor) {
  for (const double beside_m : {1.0, -0.5}) {
    const auto way_m = way_beside(hall(), kStraight_m, beside_m);
    ASSERT_GT(way_m.size(), 100U);
    for (const Vector2d& point_m : way_m) EXPECT_NEAR(point_m.y(), beside_m, 1e-6);
  }
}

TEST(WayBeside, ComesNearerWhereTheFloorEndsAndNeverLeavesIt) {
  FloorGrid grid = hall();
  shut(grid, {4.0, 0.4}, {5.0, 2.0});
  const auto way_m = way_beside(grid, kStraight_m, 1.0);
  double nearest_m = 9.0;
  double farthest_m = 0.0;
  for (std::size_t i = 0; i < way_m.size(); ++i) {
    EXPECT_TRUE(is_set(grid, way_m[i]));
    nearest_m = std::min(nearest_m, way_m[i].y());
    farthest_m = std::max(farthest_m, way_m[i].y());
    if (i == 0) continue;
    EXPECT_LT(std::abs(way_m[i].y() - way_m[i - 1].y()), 0.5 * (way_m[i].x() - way_m[i - 1].x()) + 1e-6);
  }
  EXPECT_GT(nearest_m, 0.25);
  EXPECT_LE(nearest_m, 0.4);
  EXPECT_NEAR(farthest_m, 1.0, 1e-6);
}

TEST(WayBeside, DoesNotCrossWhatStandsBetween) {
  FloorGrid grid = hall();
  shut(grid, {0.0, 0.5}, {10.0, 0.6});  // a wall with free floor behind it
  for (const Vector2d& point_m : way_beside(grid, kStraight_m, 1.0)) EXPECT_LT(point_m.y(), 0.5);
}

TEST(WayBeside, DoesNotGoBackOnTheInnerSideOfATurn) {
  const std::vector<Vector2d> turn_m = {{0.5, -1.5}, {5.0, -1.5}, {5.0, 1.9}};
  const auto way_m = way_beside(hall(), turn_m, 0.8);
  ASSERT_GT(way_m.size(), 20U);
  for (std::size_t i = 1; i < way_m.size(); ++i) {
    const Vector2d step_m = way_m[i] - way_m[i - 1];
    EXPECT_GT(step_m.x() + step_m.y(), 0.0);
  }
}

TEST(WayBeside, ATourBesideStaysOnTheFloorAndVisitsTheSameRooms) {
  const World world = generate_circuit(1);
  const auto rooms = all_rooms(world);
  const auto usual = plan_tour(world, rooms, 0.2);
  const auto beside = plan_tour(world, rooms, 0.2, 1.0);
  ASSERT_TRUE(usual);
  ASSERT_TRUE(beside);
  // Between two set cells one may cut a corner of a third, no more.
  const FloorGrid floor = drivable_cells(world.occupied, 0.3, world.start);
  double most_m = 0.0;
  std::size_t arrived = 0;
  for (const TourStop& stop : *beside) {
    const Vector2d point_m(stop.pose.x_m, stop.pose.y_m);
    EXPECT_TRUE(is_set(floor, point_m)) << point_m.transpose();
    double off_m = 1e9;
    for (const TourStop& other : *usual)
      off_m = std::min(off_m, std::hypot(other.pose.x_m - stop.pose.x_m, other.pose.y_m - stop.pose.y_m));
    most_m = std::max(most_m, off_m);
    arrived += stop.arrived ? 1 : 0;
  }
  EXPECT_GT(most_m, 0.3);
  EXPECT_LE(most_m, 1.01);
  EXPECT_EQ(arrived, 8U);
  EXPECT_FALSE(plan_tour(world, rooms, 0.2, std::nan("")));
}

}  // namespace
}  // namespace homeward::sim::way_beside_test
