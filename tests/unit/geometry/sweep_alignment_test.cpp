// SPDX-License-Identifier: Apache-2.0
#include "geometry/sweep_alignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/angles.hpp"
#include "support/drawn_walls.hpp"

namespace homeward::geometry {
namespace {

constexpr Pose2 kFirst{2.0, 2.0, 0.2};

ReferenceSurface seen_from_first() {
  ReferenceSurface reference;
  reference.add(surface_of(sweep_of(testing::two_rooms(), kFirst)), kFirst);
  return reference;
}

TEST(SweepAlignmentTest, ASweepIsPutWhereItWasTaken) {
  const Pose2 second{2.5, 2.3, 0.6};
  const auto surface = surface_of(sweep_of(testing::two_rooms(), second));
  const PosePrior prior{{2.62, 2.2, 0.7}, 0.3, 0.2};
  const auto aligned = align(seen_from_first(), surface, prior);
  ASSERT_TRUE(aligned);
  EXPECT_NEAR(aligned->reference_from_robot.x_m, second.x_m, 0.02);
  EXPECT_NEAR(aligned->reference_from_robot.y_m, second.y_m, 0.02);
  EXPECT_NEAR(aligned->reference_from_robot.theta_rad, second.theta_rad, 0.01);
  EXPECT_GT(aligned->agreement, 0.8);
}

TEST(SweepAlignmentTest, AlongACorridorThePriorHolds) {
  std::vector<testing::DrawnWall> corridor = {{{-50.0, 0.0}, {50.0, 0.0}}, {{-50.0, 2.0}, {50.0, 2.0}}};
  ReferenceSurface reference;
  reference.add(surface_of(sweep_of(corridor, {0.0, 1.0, 0.0})), {0.0, 1.0, 0.0});
  const auto surface = surface_of(sweep_of(corridor, {0.4, 1.2, 0.05}));
  const auto aligned = align(reference, surface, {{0.5, 1.0, 0.0}, 0.05, 0.05});
  ASSERT_TRUE(aligned);
  EXPECT_NEAR(aligned->reference_from_robot.x_m, 0.5, 0.03) << "nothing says how far along it is";
  EXPECT_NEAR(aligned->reference_from_robot.y_m, 1.2, 0.02);
  EXPECT_NEAR(aligned->reference_from_robot.theta_rad, 0.05, 0.01);
}

TEST(SweepAlignmentTest, WhatHasNothingInCommonIsNotAligned) {
  const auto surface = surface_of(sweep_of(testing::two_rooms(), kFirst));
  EXPECT_FALSE(align(seen_from_first(), surface, {{40.0, 2.0, 0.2}, 0.1, 0.1}));
  EXPECT_FALSE(align(ReferenceSurface(), surface, {kFirst, 0.1, 0.1}));
  EXPECT_FALSE(align(seen_from_first(), {}, {kFirst, 0.1, 0.1}));
  EXPECT_EQ(agreement(ReferenceSurface(), surface, kFirst, 0.1), 0.0);
}

TEST(SweepAlignmentTest, TheOtherSideOfAWallIsAnotherSurface) {
  std::vector<testing::DrawnWall> wall = {{{1.0, -3.0}, {1.0, 3.0}}};
  ReferenceSurface reference;
  reference.add(surface_of(sweep_of(wall, {0.0, 0.0, 0.0})), {});
  const auto behind = surface_of(sweep_of(wall, {2.0, 0.0, 0.0}));
  EXPECT_EQ(agreement(reference, behind, {2.0, 0.0, 0.0}, 0.1), 0.0);
}

TEST(SweepAlignmentTest, ThePartnerIsTheNearestPointOfAllThatFaceTheSameWay) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> at_m(-1.5, 1.5);
  std::uniform_real_distribution<double> turned_rad(-kPi, kPi);
  const auto drawn = [&] {
    const double rad = turned_rad(random);
    return SurfacePoint{{at_m(random), at_m(random)}, {std::cos(rad), std::sin(rad)}};
  };
  std::vector<SurfacePoint> surface(300);
  std::ranges::generate(surface, drawn);
  ReferenceSurface reference;
  reference.add(surface, {});
  EXPECT_EQ(ReferenceSurface().nearest(surface[0], 0.5), nullptr);
  EXPECT_FALSE(ReferenceSurface().has_near(surface[0], 0.5));
  int partners = 0;
  for (int n = 0; n < 2000; ++n) {
    const SurfacePoint seen = drawn();
    const double most_m = 0.01 + 0.4 * (n % 3);
    double least_m = most_m;
    for (const SurfacePoint& point : surface)
      if (point.normal.dot(seen.normal) >= 0.5) least_m = std::min(least_m, (point.at_m - seen.at_m).norm());
    const SurfacePoint* nearest = reference.nearest(seen, most_m);
    ASSERT_EQ(nearest != nullptr, least_m < most_m) << n;
    ASSERT_EQ(reference.has_near(seen, most_m), least_m < most_m) << n;
    if (nearest == nullptr) continue;
    EXPECT_NEAR((nearest->at_m - seen.at_m).norm(), least_m, 1e-12) << n;
    EXPECT_GE(nearest->normal.dot(seen.normal), 0.5);
    ++partners;
  }
  EXPECT_GT(partners, 500);
}

}  // namespace
}  // namespace homeward::geometry
