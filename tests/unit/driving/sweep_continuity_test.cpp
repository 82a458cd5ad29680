// SPDX-License-Identifier: Apache-2.0
#include "driving/sweep_continuity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <tuple>

#include "core/angles.hpp"

namespace homeward::driving::sweep_continuity_test {
namespace {

/// A robot that is swept ten times a second in a room of 8 by 3 m with two posts, or in one that looks nearly the same,
/// with noise of 0.01 m. Somebody of 0.24 m may be about.
class SweepContinuityTest : public ::testing::Test {
 protected:
  [[nodiscard]] double range_m(const Pose2& scanner, double angle_rad) const {
    const double c = std::cos(scanner.theta_rad + angle_rad);
    const double s = std::sin(scanner.theta_rad + angle_rad);
    double range = 1e9;
    if (std::abs(c) > 1e-9) range = std::min(range, ((c > 0 ? 4.0 : -4.0) - scanner.x_m) / c);
    if (std::abs(s) > 1e-9) range = std::min(range, ((s > 0 ? 1.5 : -1.5) - scanner.y_m) / s);
    for (const auto& [x_m, y_m, radius_m] :
         {std::tuple(-0.7, 0.9, 0.2), std::tuple(1.9, -0.8, 0.2), std::tuple(person_.x(), person_.y(), 0.24)}) {
      const double along_m = (x_m - scanner.x_m) * c + (y_m - scanner.y_m) * s;
      const double aside_m = (x_m - scanner.x_m) * -s + (y_m - scanner.y_m) * c;
      if (along_m > 0.0 && std::abs(aside_m) < radius_m) {
        range = std::min(range, along_m - std::sqrt(radius_m * radius_m - aside_m * aside_m));
      }
    }
    return std::min(range, nearest_m_);
  }
  /// A tenth of a second more; whether it says that the sweeps break off.
  bool sweep() {
    Scan scan;
    scan.robot_from_scan = scanner_;
    scan.angle_min_rad = first_rad_;
    scan.angle_step_rad = radians(1.0);
    for (int i = 0; i < rays_; ++i) {
      const double range = range_m(pose_ * scanner_, first_rad_ + i * scan.angle_step_rad) + noise_m_(random_);
      scan.ranges_m.push_back(range < scan.range_max_m ? static_cast<float>(range)
                                                       : std::numeric_limits<float>::infinity());
      if (failing_ && i % 2 == 0) scan.ranges_m.back() = std::numeric_limits<float>::quiet_NaN();
    }
    now_ms_ += 100;
    return breaks_off(continuity_, scan, odometry_, now_ms_);
  }
  bool sweep_for(int sweeps) {
    bool broken = false;
    for (int k = 0; k < sweeps; ++k) broken = sweep() || broken;
    return broken;
  }
  /// By its wheels.
  void roll(const Pose2& step) {
    pose_ = pose_ * step;
    odometry_ = odometry_ * step;
  }

  Pose2 pose_{-2.0, 0.0, 0.0};
  Pose2 odometry_{10.0, -4.0, 2.0};
  Pose2 scanner_{0.1, 0.0, 0.0};
  Eigen::Vector2d person_{50.0, 50.0};
  double nearest_m_ = 1e9;
  double first_rad_ = 0.0;
  int rays_ = 360;
  bool failing_ = false;
  SweepContinuity continuity_;
  std::int64_t now_ms_ = 5000;
  std::mt19937_64 random_{3};
  std::normal_distribution<double> noise_m_{0.0, 0.01};
};

TEST_F(SweepContinuityTest, SweepsOfADriveGoOnFromEachOther) {
  for (int k = 0; k < 80; ++k) {
    roll({0.045, 0.0, 0.1 * std::sin(0.3 * k)});
    ASSERT_FALSE(sweep()) << k;
  }
  ASSERT_TRUE(continuity_.contradiction);
  EXPECT_LT(*continuity_.contradiction, 0.02);
}

TEST_F(SweepContinuityTest, LiftedAQuarterOfAMetreOnItBreaksOffWithinHalfASecondAndOnce) {
  ASSERT_FALSE(sweep_for(10));
  pose_.x_m += 0.25;
  EXPECT_TRUE(sweep_for(5));
  EXPECT_FALSE(sweep_for(20));
}

TEST_F(SweepContinuityTest, TurnedInTheAirItBreaksOff) {
  ASSERT_FALSE(sweep_for(10));
  pose_.theta_rad += 0.3;
  EXPECT_TRUE(sweep_for(5));
}

TEST_F(SweepContinuityTest, CarriedAwayStepByStepItBreaksOff) {
  ASSERT_FALSE(sweep_for(10));
  bool broken = false;
  for (int k = 0; k < 20; ++k) {
    pose_.x_m += 0.05;
    broken = sweep() || broken;
  }
  EXPECT_TRUE(broken);
}

TEST_F(SweepContinuityTest, WhoeverWalksByBreaksOffNothing) {
  for (int k = 0; k < 60; ++k) {
    person_ = {-3.5 + 0.12 * k, 0.6};
    ASSERT_FALSE(sweep()) << k;
  }
}

TEST_F(SweepContinuityTest, WhatIsPutBeforeTheRobotAndTakenAwayBreaksOffNothing) {
  ASSERT_FALSE(sweep_for(10));
  person_ = {-1.4, 0.0};
  EXPECT_FALSE(sweep_for(10));
  person_ = {50.0, 50.0};
  EXPECT_FALSE(sweep_for(10));
}

TEST_F(SweepContinuityTest, ABumpOfTheFloorThatShowsSomethingElseForAMomentBreaksOffNothing) {
  ASSERT_FALSE(sweep_for(10));
  const Pose2 there = pose_;
  pose_ = {1.0, 0.3, 0.4};
  EXPECT_FALSE(sweep_for(2));
  pose_ = there;
  EXPECT_FALSE(sweep_for(10));
}

TEST_F(SweepContinuityTest, WheelsThatSlipByHalfBreakOffNothing) {
  for (int k = 0; k < 60; ++k) {
    pose_ = pose_ * Pose2{0.0225, 0.0, 0.0};
    odometry_ = odometry_ * Pose2{0.045, 0.0, 0.0};
    ASSERT_FALSE(sweep()) << k;
  }
}

TEST_F(SweepContinuityTest, AScannerThatLooksAheadAloneTellsOfALiftToo) {
  first_rad_ = -0.5 * kPi;
  rays_ = 181;
  ASSERT_FALSE(sweep_for(10));
  pose_.theta_rad += 0.3;
  EXPECT_TRUE(sweep_for(5));
}

TEST_F(SweepContinuityTest, AfterASilenceAndWhereRaysFailNothingIsSaid) {
  ASSERT_FALSE(sweep_for(10));
  now_ms_ += 600;
  pose_.x_m += 1.0;
  EXPECT_FALSE(sweep_for(10));
  failing_ = true;
  EXPECT_FALSE(sweep_for(10));
  EXPECT_FALSE(continuity_.contradiction);
}

TEST(Contradiction, OfSweepsThatMetNothingThereIsNone) {
  Scan open;
  open.ranges_m.assign(360, std::numeric_limits<float>::infinity());
  open.angle_step_rad = radians(1.0);
  EXPECT_EQ(contradiction(open, open, {0.1, 0.0, 0.0}), 0.0);
  EXPECT_FALSE(contradiction({}, open, {}));
  open.range_max_m = std::numeric_limits<double>::infinity();
  EXPECT_EQ(contradiction(open, open, {0.1, 0.0, 0.0}), 0.0);
}

}  // namespace
}  // namespace homeward::driving::sweep_continuity_test
