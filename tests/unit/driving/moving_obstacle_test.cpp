// SPDX-License-Identifier: Apache-2.0
#include "driving/moving_obstacle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/angles.hpp"

namespace homeward::driving::moving_obstacle_test {
namespace {

/// A room of 8 by 3 m with a post of 0.1 m in it and somebody of 0.24 m, swept with noise of 0.01 m.
class MovingObstacleTest : public ::testing::Test {
 protected:
  [[nodiscard]] double range_m(const Pose2& scanner, double angle_rad) const {
    const double c = std::cos(scanner.theta_rad + angle_rad);
    const double s = std::sin(scanner.theta_rad + angle_rad);
    double range = 1e9;
    if (std::abs(c) > 1e-9) range = std::min(range, ((c > 0 ? 4.0 : -4.0) - scanner.x_m) / c);
    if (std::abs(s) > 1e-9) range = std::min(range, ((s > 0 ? 1.5 : -1.5) - scanner.y_m) / s);
    for (const auto& [x_m, y_m, radius_m] : {std::tuple(-0.7, 0.9, 0.1), std::tuple(person_.x(), person_.y(), 0.24)}) {
      const double along_m = (x_m - scanner.x_m) * c + (y_m - scanner.y_m) * s;
      const double aside_m = (x_m - scanner.x_m) * -s + (y_m - scanner.y_m) * c;
      if (along_m > 0.0 && std::abs(aside_m) < radius_m) {
        range = std::min(range, along_m - std::sqrt(radius_m * radius_m - aside_m * aside_m));
      }
    }
    return range;
  }
  /// A tenth of a second more.
  void sweep() {
    Scan scan;
    scan.robot_from_scan = scanner_;
    scan.angle_min_rad = first_rad_;
    scan.angle_step_rad = step_rad_;
    for (int i = 0; i < rays_; ++i) {
      const double range = range_m(pose_ * scanner_, first_rad_ + i * step_rad_) + noise_m_(random_);
      scan.ranges_m.push_back(range < scan.range_max_m ? static_cast<float>(range)
                                                       : std::numeric_limits<float>::infinity());
      if (failing_ && i < 40) scan.ranges_m.back() = std::numeric_limits<float>::quiet_NaN();
    }
    now_ms_ += 100;
    watch(state_, scan, pose_, now_ms_);
  }

  Pose2 pose_;
  Pose2 scanner_{0.1, 0.0, 0.0};
  Eigen::Vector2d person_{1.2, 0.1};
  double first_rad_ = 0.0;
  double step_rad_ = radians(1.0);
  int rays_ = 360;
  bool failing_ = false;
  MovingObstacle state_;
  std::int64_t now_ms_ = 5000;
  std::mt19937_64 random_{3};
  std::normal_distribution<double> noise_m_{0.0, 0.01};
};

TEST_F(MovingObstacleTest, NothingMovesWhileTheRobotStandsOrTurnsBeforeAThing) {
  for (int k = 0; k < 200; ++k) {
    if (k >= 100) pose_.theta_rad += 0.12 * std::sin(0.05 * k);
    sweep();
    ASSERT_FALSE(state_.seen_ms) << k;
  }
}

TEST_F(MovingObstacleTest, NothingMovesWhileTheRobotDrivesByAThing) {
  for (int k = 0; k < 100; ++k) {
    pose_ = {-2.0 + 0.03 * k, -0.6, 0.01 * k};
    sweep();
    ASSERT_FALSE(state_.seen_ms) << k;
  }
}

TEST_F(MovingObstacleTest, SomebodyWhoTakesAStepIsSeenWithinTwoSeconds) {
  for (int k = 0; k < 30; ++k) sweep();
  for (int k = 0; k < 20; ++k) {
    pose_.theta_rad += 0.1;
    if (k < 8) person_.y() -= 0.08;
    sweep();
  }
  ASSERT_TRUE(state_.seen_ms);
  EXPECT_GT(*state_.seen_ms, 5000 + 3000);
}

TEST_F(MovingObstacleTest, ASweepThatRunsTheOtherWayOrSeesHalfTheRoomOnlyDoesAsWell) {
  step_rad_ = -radians(0.75);
  first_rad_ = radians(100.0);
  rays_ = 267;
  for (int k = 0; k < 30; ++k) {
    pose_.theta_rad += 0.02;
    sweep();
  }
  EXPECT_FALSE(state_.seen_ms);
  for (int k = 0; k < 12; ++k) {
    person_.y() -= 0.08;
    sweep();
  }
  EXPECT_TRUE(state_.seen_ms);
}

TEST_F(MovingObstacleTest, RaysThatFailNowAndThenAreNobody) {
  for (int k = 0; k < 60; ++k) {
    failing_ = (k / 10) % 2 == 0;
    sweep();
  }
  EXPECT_FALSE(state_.seen_ms);
}

TEST_F(MovingObstacleTest, ASweepWithoutRaysOrStepsSaysNothing) {
  sweep();
  Scan empty;
  for (int k = 0; k < 20; ++k) watch(state_, empty, pose_, now_ms_ += 600);
  for (int k = 0; k < 20; ++k) sweep();
  EXPECT_FALSE(state_.seen_ms);
}

TEST_F(MovingObstacleTest, WhatMovesFarOffDoesNotStandInTheWay) {
  pose_.x_m = -3.0;
  for (int k = 0; k < 60; ++k) {
    person_.x() = 1.2 + std::sin(0.3 * k);
    sweep();
  }
  EXPECT_FALSE(state_.seen_ms);
}

}  // namespace
}  // namespace homeward::driving::moving_obstacle_test
