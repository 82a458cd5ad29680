// SPDX-License-Identifier: Apache-2.0
#include "driving/look_around.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/angles.hpp"

namespace homeward::driving::look_around_test {
namespace {

/// What a sweep hits in a corridor of this width along the odometry's x axis, open to +x and closed at `end_m`.
std::vector<Eigen::Vector2d> corridor_from(const Pose2& odometry, double width_m, double end_m) {
  std::vector<Eigen::Vector2d> points_m;
  const auto add = [&](double x_m, double y_m) {
    const Pose2 point = inverse(odometry) * Pose2{x_m, y_m, 0.0};
    points_m.emplace_back(point.x_m, point.y_m);
  };
  for (double x_m = end_m; x_m < odometry.x_m + 8.0; x_m += 0.05) {
    add(x_m, 0.5 * width_m);
    add(x_m, -0.5 * width_m);
  }
  for (double y_m = -0.5 * width_m; y_m < 0.5 * width_m; y_m += 0.05) add(end_m, y_m);
  return points_m;
}

TEST(LookAround, DrivesAlongACorridorAwayFromItsEndAndNeverTowardsAWall) {
  LookAround looking;
  Pose2 odometry{0.8, 0.0, 0.5 * kPi};
  for (int k = 0; k < 60; ++k) {
    const auto aim_m = look_around(looking, Body{}, corridor_from(odometry, 1.8, 0.0), odometry);
    ASSERT_TRUE(aim_m) << k;
    const Pose2 aim = odometry * Pose2{aim_m->x(), aim_m->y(), 0.0};
    EXPECT_LT(std::abs(aim.y_m), 0.5) << k;
    odometry = {odometry.x_m + 0.1 * (aim.x_m > odometry.x_m ? 1.0 : -1.0), odometry.y_m, odometry.theta_rad};
  }
  EXPECT_GT(odometry.x_m, 5.0);
}

TEST(LookAround, HasNowhereToGoWhereThingsAreNearAllAround) {
  LookAround looking;
  std::vector<Eigen::Vector2d> points_m;
  for (int k = 0; k < 90; ++k) points_m.push_back(0.8 * Eigen::Vector2d(std::cos(0.07 * k), std::sin(0.07 * k)));
  EXPECT_FALSE(look_around(looking, Body{}, points_m, {}));
}

TEST(LookAround, GivesUpWhenItHasDrivenFarEnough) {
  LookAround looking;
  double x_m = 0.0;
  while (look_around(looking, Body{}, {}, {x_m, 0.0, 0.0})) {
    x_m += 0.1;
    ASSERT_LT(x_m, LookAroundConfig{}.most_m + 1.0);
  }
  EXPECT_GT(x_m, LookAroundConfig{}.most_m - 0.5);
}

}  // namespace
}  // namespace homeward::driving::look_around_test
