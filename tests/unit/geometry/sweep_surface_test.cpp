// SPDX-License-Identifier: Apache-2.0
#include "geometry/sweep_surface.hpp"

#include <gtest/gtest.h>

#include "support/drawn_walls.hpp"

namespace homeward::geometry {
namespace {

RangeSweep room_sweep() { return sweep_of(testing::two_rooms(), {2.5, 2.0, 0.3}); }

TEST(SweepSurfaceTest, PointsLieOnWallsAndNormalsLookAtTheScanner) {
  const Pose2 pose{2.5, 2.0, 0.3};
  const auto surface = surface_of(room_sweep());
  ASSERT_GT(surface.size(), 300U);
  for (const SurfacePoint& point : surface) {
    EXPECT_LT(point.normal.dot(point.at_m), 0.0);
    EXPECT_NEAR(point.normal.norm(), 1.0, 1e-9);
    const Pose2 at = pose * Pose2{point.at_m.x(), point.at_m.y(), 0.0};
    EXPECT_GE(at.x_m, -1e-3);
    EXPECT_GE(at.y_m, -1e-3);
    EXPECT_LE(at.y_m, 4.001);
  }
}

TEST(SweepSurfaceTest, AReturnThatNoNeighbourSharesIsLeftOut) {
  RangeSweep sweep = room_sweep();
  const std::size_t all = surface_of(sweep).size();
  sweep.ranges_m[10] = 1.0F;
  EXPECT_EQ(surface_of(sweep).size(), all - 1);
  sweep.ranges_m[10] = 9.0F;
  EXPECT_EQ(surface_of(sweep).size(), all - 1);
}

TEST(SweepSurfaceTest, ReturnsThatAreTooNearOrNoneAtAllAreLeftOut) {
  RangeSweep sweep = room_sweep();
  for (float& range_m : sweep.ranges_m) range_m = 0.02F;
  EXPECT_TRUE(surface_of(sweep).empty());
  for (float& range_m : sweep.ranges_m) range_m = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(surface_of(sweep).empty());
  for (float& range_m : sweep.ranges_m) range_m = 12.0F;
  EXPECT_TRUE(surface_of(sweep).empty()) << "as far as it measures is nothing seen";
  EXPECT_TRUE(surface_of({}).empty());
}

TEST(SweepSurfaceTest, AScannerThatLooksForwardAloneDoesNotJoinItsEnds) {
  RangeSweep sweep;
  sweep.angle_min_rad = -0.1;
  sweep.angle_step_rad = 0.1;
  sweep.ranges_m = {1.0F, 5.0F, 1.0F};
  EXPECT_TRUE(surface_of(sweep).empty());
}

}  // namespace
}  // namespace homeward::geometry
