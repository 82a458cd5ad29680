// SPDX-License-Identifier: Apache-2.0
#include "exploration/explored_floor.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/drawn_walls.hpp"

namespace homeward::exploration {
namespace {

class ExploredFloorTest : public ::testing::Test {
 protected:
  void see(const Pose2& pose) {
    const RangeSweep sweep = sweep_of(testing::two_rooms(), pose);
    floor_.see(sweep, geometry::surface_of(sweep), pose);
  }
  [[nodiscard]] std::size_t cell(double x_m, double y_m) const {
    return floor_.frame().index(floor_.frame().cell({x_m, y_m}));
  }
  ExploredFloor floor_;
};

TEST_F(ExploredFloorTest, WhatRaysPassIsFreeWhatTheyMeetIsNotAndTheRestIsUnknown) {
  see({2.0, 2.0, 0.4});
  EXPECT_TRUE(floor_.is_free(cell(1.0, 1.0)));
  EXPECT_TRUE(floor_.is_free(cell(4.5, 3.5)));
  EXPECT_TRUE(floor_.is_occupied(cell(2.0, -0.001)) || floor_.is_occupied(cell(2.0, 0.001)));
  EXPECT_TRUE(floor_.is_unknown(cell(6.0, 0.5))) << "behind the wall";
  EXPECT_TRUE(floor_.in_sight({1.0, 1.0}, {4.0, 3.0}));
  EXPECT_FALSE(floor_.in_sight({4.0, 0.7}, {6.0, 0.7}));
}

TEST_F(ExploredFloorTest, ItGrowsWithTheRobotAndKeepsWhatItKnows) {
  see({1.0, 2.0, 0.0});
  const FloorFrame before = floor_.frame();
  EXPECT_TRUE(floor_.is_free(cell(1.0, 1.0)));
  see({9.0, 2.0, 1.0});
  EXPECT_GT(floor_.frame().columns, before.columns);
  EXPECT_TRUE(floor_.is_free(cell(1.0, 1.0)));
  EXPECT_TRUE(floor_.is_free(cell(9.0, 3.0)));
}

TEST_F(ExploredFloorTest, ARayThatComesBackWithNothingSaysNothing) {
  RangeSweep sweep = sweep_of(testing::two_rooms(), {2.0, 2.0, 0.0});
  for (std::size_t i = 80; i < 100; ++i) sweep.ranges_m[i] = std::numeric_limits<float>::infinity();
  floor_.see(sweep, geometry::surface_of(sweep), {2.0, 2.0, 0.0});
  EXPECT_TRUE(floor_.is_unknown(cell(2.0, 3.5)));
}

TEST_F(ExploredFloorTest, OneReturnOfNothingIsOutvoted) {
  RangeSweep sweep = sweep_of(testing::two_rooms(), {2.0, 2.0, 0.0});
  const std::vector<geometry::SurfacePoint> ghost = {{{1.0, 0.0}, {-1.0, 0.0}}};
  floor_.see(sweep, ghost, {2.0, 2.0, 0.0});
  EXPECT_TRUE(floor_.is_occupied(cell(3.0, 2.0)));
  for (int i = 0; i < 5; ++i) see({2.0, 2.0 + 0.05 * i, 0.0});
  EXPECT_TRUE(floor_.is_free(cell(3.0, 2.0)));
}

TEST_F(ExploredFloorTest, ASweepOfNothingChangesNothing) {
  floor_.see({}, {}, {});
  EXPECT_EQ(floor_.frame().size(), 0U);
}

}  // namespace
}  // namespace homeward::exploration
