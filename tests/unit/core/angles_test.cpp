// SPDX-License-Identifier: Apache-2.0
#include "core/angles.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/pose2.hpp"

namespace homeward {
namespace {

TEST(Angles, WrapIntoHalfOpenCircle) {
  EXPECT_DOUBLE_EQ(wrap_angle(kPi), kPi);
  EXPECT_DOUBLE_EQ(wrap_angle(-kPi), kPi);
  EXPECT_NEAR(wrap_angle(3.0 * kPi + 0.25), -kPi + 0.25, 1e-12);
  EXPECT_NEAR(wrap_angle(-0.5 - 20.0 * kPi), -0.5, 1e-12);
  EXPECT_DOUBLE_EQ(wrap_angle(0.0), 0.0);
}

TEST(Angles, MedianCrossesTheSeamAndIgnoresAnOutlier) {
  const std::vector<double> angles_rad = {kPi - 0.1, -kPi + 0.1, kPi - 0.02, 0.3, -kPi + 0.05};
  EXPECT_LT(std::abs(wrap_angle(circular_median(angles_rad) - kPi)), 0.11);
}

TEST(Pose2, InverseUndoesATransform) {
  const Pose2 world_from_robot{1.5, -2.0, 2.9};
  const Pose2 identity = world_from_robot * inverse(world_from_robot);
  EXPECT_NEAR(identity.x_m, 0.0, 1e-12);
  EXPECT_NEAR(identity.y_m, 0.0, 1e-12);
  EXPECT_NEAR(identity.theta_rad, 0.0, 1e-12);
}

}  // namespace
}  // namespace homeward
