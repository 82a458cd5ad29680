// SPDX-License-Identifier: Apache-2.0
#include "sim/box.hpp"

#include <gtest/gtest.h>

#include "core/angles.hpp"
#include "sim/floor.hpp"

namespace homeward::sim::box_test {
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

}  // namespace
}  // namespace homeward::sim::box_test
