// SPDX-License-Identifier: Apache-2.0
#include "sim/box.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/angles.hpp"
#include "sim/floor.hpp"

namespace homeward::sim::box_test {
namespace {

constexpr double kFarAway_m = 8.0;

TEST(Box, IsMetWhereItsNearestFaceStands) {
  const Box box{{2.0, 0.0, 0.0}};
  const auto met = hit_box(box, {0.0F, 0.0F, 0.5F}, {1.0F, 0.0F, 0.0F});
  ASSERT_TRUE(met);
  EXPECT_NEAR(met->distance_m, 1.75, 1e-5);
  EXPECT_GT(met->albedo.minCoeff(), 0.0F);
  EXPECT_LT(met->albedo.maxCoeff(), 1.0F);
}

TEST(Box, IsMissedAboveBesideAndBehind) {
  const Box box{{2.0, 0.0, 0.0}};
  EXPECT_FALSE(hit_box(box, {0.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 0.0F}));
  EXPECT_FALSE(hit_box(box, {0.0F, 0.3F, 0.5F}, {1.0F, 0.0F, 0.0F}));
  EXPECT_FALSE(hit_box(box, {0.0F, 0.0F, 0.5F}, {-1.0F, 0.0F, 0.0F}));
}

TEST(Box, TurnsWithItsPose) {
  const Box box{{2.0, 0.0, 0.25 * kPi}};
  const auto met = hit_box(box, {0.0F, 0.0F, 0.5F}, {1.0F, 0.0F, 0.0F});
  ASSERT_TRUE(met);
  EXPECT_NEAR(met->distance_m, 2.0 - 0.5 * std::sqrt(0.5), 1e-4) << "an edge points to the viewer";
}

TEST(Box, IsSeenFromAbove) {
  const Box box{};
  const auto met = hit_box(box, {0.1F, 0.1F, 2.0F}, {0.0F, 0.0F, -1.0F});
  ASSERT_TRUE(met);
  EXPECT_NEAR(met->distance_m, 1.1, 1e-5);
}

TEST(Box, IsMetWhereItsOutlineBeginsRoundOrAngular) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> across_m(-2.0, 2.0);
  std::uniform_real_distribution<double> angle_rad(-kPi, kPi);
  const Outline disc;
  const Outline chair{0.0, 0.25, 0.85, 0.325};
  const Outline rounded{0.1, 0.2, 0.6, 0.25};
  int met = 0;
  for (int k = 0; k < 1500; ++k) {
    const Outline& foot = k % 3 == 0 ? disc : k % 3 == 1 ? chair : rounded;
    const Box box{{across_m(random), across_m(random), angle_rad(random)}, foot, 0.9};
    const Eigen::Vector2d from_m(across_m(random), across_m(random));
    const double heading_rad = angle_rad(random);
    const auto beyond_m = [&](double along_m) {
      const Pose2 at = inverse(box.pose) * Pose2{from_m.x() + along_m * std::cos(heading_rad),
                                                 from_m.y() + along_m * std::sin(heading_rad), 0.0};
      return distance_m(foot, {at.x_m, at.y_m});
    };
    if (beyond_m(0.0) < 1e-3) continue;
    double nearest_m = kFarAway_m;
    double along_m = 0.0;
    for (; along_m < kFarAway_m; along_m += std::max(1e-4, beyond_m(along_m))) {
      nearest_m = std::min(nearest_m, beyond_m(along_m));
      if (nearest_m < 1e-4) break;
    }
    if (nearest_m > 1e-4 && nearest_m < 1e-2) continue;  // grazed
    const auto hit =
        hit_box(box, {static_cast<float>(from_m.x()), static_cast<float>(from_m.y()), 0.5F},
                {static_cast<float>(std::cos(heading_rad)), static_cast<float>(std::sin(heading_rad)), 0.0F});
    EXPECT_EQ(hit.has_value(), nearest_m < 1e-4) << k;
    if (!hit) continue;
    ++met;
    EXPECT_NEAR(beyond_m(static_cast<double>(hit->distance_m)), 0.0, 1e-3) << k;
    EXPECT_NEAR(static_cast<double>(hit->distance_m), along_m, 0.02) << k;
  }
  EXPECT_GT(met, 100);
}

TEST(Box, OfADiscIsSeenFromAboveWithinItsCircleOnly) {
  const Box box{{1.0, 2.0, 0.7}, Outline{}, 0.9};
  const auto met = hit_box(box, {1.24F, 2.24F, 2.0F}, {0.0F, 0.0F, -1.0F});
  ASSERT_TRUE(met);
  EXPECT_NEAR(met->distance_m, 1.1, 1e-5);
  EXPECT_FALSE(hit_box(box, {1.26F, 2.26F, 2.0F}, {0.0F, 0.0F, -1.0F})) << "a corner of the square about it";
}

}  // namespace
}  // namespace homeward::sim::box_test
