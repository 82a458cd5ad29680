// SPDX-License-Identifier: Apache-2.0
#include "core/angles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/pose2.hpp"

namespace homeward::angles_test {
namespace {

TEST(Angles, WrapIntoHalfOpenCircle) {
  EXPECT_DOUBLE_EQ(wrap_angle(kPi), kPi);
  EXPECT_DOUBLE_EQ(wrap_angle(-kPi), kPi);
  EXPECT_NEAR(wrap_angle(3.0 * kPi + 0.25), -kPi + 0.25, 1e-12);
  EXPECT_NEAR(wrap_angle(-0.5 - 20.0 * kPi), -0.5, 1e-12);
  EXPECT_DOUBLE_EQ(wrap_angle(0.0), 0.0);
}

TEST(Angles, WrappingIsTheExactRemainder) {
  for (int i = -4000; i <= 4000; ++i) {
    const double angle_rad = 0.005 * i + 1e-9 * (i % 7);
    const double remainder_rad = std::remainder(angle_rad, 2.0 * kPi);
    EXPECT_EQ(wrap_angle(angle_rad), remainder_rad <= -kPi ? kPi : remainder_rad) << angle_rad;
  }
  for (const double turns : {-1.5, -0.5, 0.5, 1.5}) {
    const double edge_rad = turns * 2.0 * kPi;
    for (const double angle_rad : {std::nextafter(edge_rad, -10.0), edge_rad, std::nextafter(edge_rad, 10.0)}) {
      const double remainder_rad = std::remainder(angle_rad, 2.0 * kPi);
      EXPECT_EQ(wrap_angle(angle_rad), remainder_rad <= -kPi ? kPi : remainder_rad) << angle_rad;
    }
  }
}

TEST(Angles, MedianHasTheLeastSumOfDistancesAndTheFirstOfEquals) {
  std::vector<double> angles_rad;
  for (int i = 0; i < 53; ++i) {
    angles_rad.push_back(std::fmod(1.7 * i * i, 2.0 * kPi) - kPi);
    const auto cost = [&](double candidate_rad) {
      double sum = 0.0;
      for (const double angle_rad : angles_rad) sum += std::abs(wrap_angle(angle_rad - candidate_rad));
      return sum;
    };
    EXPECT_EQ(circular_median(angles_rad), wrap_angle(*std::ranges::min_element(angles_rad, {}, cost)));
  }
  EXPECT_NEAR(circular_median(std::vector<double>{7.0, 7.1, 7.3}), 7.1 - 2.0 * kPi, 1e-12);
  EXPECT_EQ(circular_median(std::vector<double>{0.2, 0.1}), 0.2);
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
}  // namespace homeward::angles_test
