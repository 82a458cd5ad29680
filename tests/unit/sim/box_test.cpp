// SPDX-License-Identifier: Apache-2.0
#include "sim/box.hpp"

#include <gtest/gtest.h>

#include "core/angles.hpp"
#include "sim/floor.hpp"

namespace homeward::sim {
namespace {

TEST(Box, IsMetWhereItsNearestFaceStands) {
  const Box box{{2.0, 0.0, 0.0}, 0.5, 0.9};
  const auto met = hit_box(box, {0.0F, 0.0F, 0.5F}, {1.0F, 0.0F, 0.0F});
  ASSERT_TRUE(met);
  EXPECT_NEAR(met->distance_m, 1.75, 1e-5);
  EXPECT_GT(met->albedo.minCoeff(), 0.0F);
  EXPECT_LT(met->albedo.maxCoeff(), 1.0F);
}

TEST(Box, IsMissedAboveBesideAndBehind) {
  const Box box{{2.0, 0.0, 0.0}, 0.5, 0.9};
  EXPECT_FALSE(hit_box(box, {0.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 0.0F}));
  EXPECT_FALSE(hit_box(box, {0.0F, 0.3F, 0.5F}, {1.0F, 0.0F, 0.0F}));
  EXPECT_FALSE(hit_box(box, {0.0F, 0.0F, 0.5F}, {-1.0F, 0.0F, 0.0F}));
}

TEST(Box, TurnsWithItsPose) {
  const Box box{{2.0, 0.0, 0.25 * kPi}, 0.5, 0.9};
  const auto met = hit_box(box, {0.0F, 0.0F, 0.5F}, {1.0F, 0.0F, 0.0F});
  ASSERT_TRUE(met);
  EXPECT_NEAR(met->distance_m, 2.0 - 0.5 * std::sqrt(0.5), 1e-4) << "an edge points to the viewer";
}

TEST(Box, IsSeenFromAbove) {
  const Box box{{0.0, 0.0, 0.0}, 0.5, 0.9};
  const auto met = hit_box(box, {0.1F, 0.1F, 2.0F}, {0.0F, 0.0F, -1.0F});
  ASSERT_TRUE(met);
  EXPECT_NEAR(met->distance_m, 1.1, 1e-5);
}

TEST(Box, MarksItsCellsAndNoOthers) {
  FloorGrid grid;
  grid.width = grid.height = 40;
  grid.origin_m = {-1.0, -1.0};
  grid.cells.assign(1600, 0);
  mark_box(grid, {{0.0, 0.0, 0.0}, 0.5, 0.9});
  EXPECT_TRUE(is_set(grid, {0.0, 0.0}));
  EXPECT_TRUE(is_set(grid, {0.22, -0.22}));
  EXPECT_FALSE(is_set(grid, {0.32, 0.0}));
  mark_box(grid, {{0.95, 0.95, 0.0}, 0.5, 0.9});  // over the rim
  EXPECT_TRUE(is_set(grid, {0.95, 0.95}));
}

}  // namespace
}  // namespace homeward::sim
