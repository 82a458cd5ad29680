// SPDX-License-Identifier: Apache-2.0
#include "sim/floor.hpp"

#include <gtest/gtest.h>

#include "support/box_world.hpp"

namespace homeward::sim::floor_test {
namespace {

FloorGrid random_grid(int width, int height, double share, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  FloorGrid grid;
  grid.width = width;
  grid.height = height;
  grid.resolution_m = 0.1;
  grid.origin_m = {-1.0, 2.0};
  for (int i = 0; i < width * height; ++i) {
    grid.cells.push_back(static_cast<double>(random() % 1000) < 1000.0 * share ? 255 : 0);
  }
  return grid;
}

TEST(Clearance, IsThatOfBruteForce) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const FloorGrid grid = random_grid(23, 17, seed % 2 == 0 ? 0.02 : 0.2, seed);
    const std::vector<float> fast = clearance(grid);
    for (int row = 0; row < grid.height; ++row) {
      for (int column = 0; column < grid.width; ++column) {
        int nearest2 = 1 << 30;
        for (int r = 0; r < grid.height; ++r) {
          for (int c = 0; c < grid.width; ++c) {
            if (grid.cells[static_cast<std::size_t>(r * grid.width + c)] == 0) continue;
            nearest2 = std::min(nearest2, (r - row) * (r - row) + (c - column) * (c - column));
          }
        }
        if (nearest2 == 1 << 30) continue;
        EXPECT_NEAR(fast[static_cast<std::size_t>(row * grid.width + column)], 0.1 * std::sqrt(nearest2), 1e-4);
      }
    }
  }
}

TEST(Clearance, IsFarWhereNothingStands) {
  for (const float clear_m : clearance(random_grid(5, 4, 0.0, 1))) EXPECT_GT(clear_m, 1000.0F);
}

TEST(FloorCells, GoThereAndBack) {
  const FloorGrid grid = random_grid(23, 17, 0.5, 3);
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      EXPECT_EQ(cell_of(grid, centre_of(grid, {column, row})), Eigen::Vector2i(column, row));
      const bool set = grid.cells[static_cast<std::size_t>(row * grid.width + column)] != 0;
      EXPECT_EQ(is_set(grid, centre_of(grid, {column, row})), set);
    }
  }
  EXPECT_EQ(cell_of(grid, {-0.95, 2.05}), Eigen::Vector2i(0, 16));  // lower left corner: last row
  EXPECT_FALSE(is_set(grid, {-1.05, 2.05}));
  EXPECT_FALSE(is_set(grid, {100.0, 2.05}));
}

TEST(OccupiedCells, MarkWallsAndNothingElse) {
  const World world = homeward::testing::box_world(true);
  EXPECT_TRUE(is_set(world.occupied, {1.999, 0.0}) || is_set(world.occupied, {2.001, 0.0}));
  EXPECT_TRUE(is_set(world.occupied, {-0.05, 0.7}) || is_set(world.occupied, {-0.051, 0.7}));
  EXPECT_FALSE(is_set(world.occupied, {0.0, -0.7}));
  EXPECT_FALSE(is_set(world.occupied, {1.0, 1.0}));  // floor and ceiling do not count
}

TEST(DrivableCells, KeepTheRobotsRadiusAndAreReachable) {
  World world = homeward::testing::box_world(true);
  const std::vector<float> clear_m = clearance(world.occupied);
  for (std::size_t i = 0; i < world.drivable.cells.size(); ++i) {
    if (world.drivable.cells[i] == 0) continue;
    EXPECT_GT(clear_m[i], 0.35F);
  }
  EXPECT_TRUE(is_set(world.drivable, {1.0, 0.7}));   // round the wall
  EXPECT_FALSE(is_set(world.drivable, {0.0, 0.7}));  // in it
  EXPECT_FALSE(is_set(world.drivable, {2.3, 0.0}));  // outside the house
  // A robot that is too wide for the passage stays on its side.
  const FloorGrid wide = drivable_cells(world.occupied, 0.8, {-1.0, 0.0, 0.0});
  EXPECT_TRUE(is_set(wide, {-1.0, 0.0}));
  EXPECT_FALSE(is_set(wide, {1.0, 0.0}));
}

TEST(ShortestWay, GoesRoundAWallOverFreeCells) {
  const World world = homeward::testing::box_world(true);
  const auto way_m = shortest_way(world.drivable, {-1.0, 0.7}, {1.0, 0.7});
  ASSERT_GT(way_m.size(), 2U);
  EXPECT_LT((way_m.front() - Eigen::Vector2d(-1.0, 0.7)).norm(), 0.06);
  EXPECT_LT((way_m.back() - Eigen::Vector2d(1.0, 0.7)).norm(), 0.06);
  for (std::size_t i = 0; i < way_m.size(); ++i) {
    EXPECT_TRUE(is_set(world.drivable, way_m[i]));
    if (i == 0) continue;
    EXPECT_LT((way_m[i] - way_m[i - 1]).norm(), 0.0708);
  }
  // Round the end of the wall, 0.35 m below it at least and half way to the other side at most, over eight neighbours.
  EXPECT_GT(length_m(way_m), 2.8);
  EXPECT_LT(length_m(way_m), 4.3);
}

TEST(ShortestWay, IsStraightInTheOpenAndNothingWhereThereIsNone) {
  const World world = homeward::testing::box_world(false);
  EXPECT_NEAR(length_m(shortest_way(world.drivable, {-1.0, 0.0}, {1.0, 0.0})), 2.0, 0.15);
  FloorGrid parted = world.drivable;
  for (int row = 0; row < parted.height; ++row) {
    const int column = cell_of(parted, {0.0, 0.0}).x();
    parted.cells[static_cast<std::size_t>(row * parted.width + column)] = 0;
  }
  EXPECT_TRUE(shortest_way(parted, {-1.0, 0.0}, {1.0, 0.0}).empty());
  std::fill(parted.cells.begin(), parted.cells.end(), std::uint8_t{0});
  EXPECT_TRUE(shortest_way(parted, {-1.0, 0.0}, {1.0, 0.0}).empty());
}

TEST(RoomAt, IsTheOutlineThatHoldsThePoint) {
  const World world = homeward::testing::box_world(false);
  EXPECT_EQ(room_at(world, {-0.5, 1.2}), "west");
  EXPECT_EQ(room_at(world, {0.5, -1.2}), "east");
  EXPECT_EQ(room_at(world, {0.5, -1.7}), std::nullopt);
}

TEST(RandomFreePoint, IsAlwaysFree) {
  const World world = homeward::testing::box_world(true);
  std::mt19937_64 random(4);
  for (int i = 0; i < 200; ++i) EXPECT_TRUE(is_set(world.drivable, random_free_point(world.drivable, random)));
}

}  // namespace
}  // namespace homeward::sim::floor_test
