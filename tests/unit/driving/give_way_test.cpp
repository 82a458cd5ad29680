// SPDX-License-Identifier: Apache-2.0
#include "driving/give_way.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace homeward::driving::give_way_test {
namespace {

/// A robot on a straight way along x that drives wherever it is sent, without things to heed.
class GiveWayTest : public ::testing::Test {
 protected:
  static constexpr std::int64_t kTick_ms = 100;
  static constexpr std::int64_t kPatience_ms = 5000;

  void drive_to(double x_m) {
    for (; pose_.x_m < x_m; pose_.x_m += 0.03) tick();
  }
  /// One tick later; true when it is free to go on.
  bool tick() {
    now_ms_ += kTick_ms;
    remember_trail(state_, pose_);
    if (somebody_moves_) obstacle_moved_ms_ = now_ms_;
    const auto back_to_m = give_way(state_, body_, {points_m(), obstacle_moved_ms_}, pose_, now_ms_, kPatience_ms);
    if (!back_to_m) return true;
    const double step_m = std::min(0.03, back_to_m->norm());
    if (step_m > 0.0) {
      const Pose2 moved =
          pose_ * Pose2{step_m * back_to_m->x() / back_to_m->norm(), step_m * back_to_m->y() / back_to_m->norm(), 0};
      pose_.x_m = moved.x_m;
      pose_.y_m = moved.y_m;
    }
    return false;
  }
  /// Stands, blocked, until it backs off or `at_most_ms` are over; milliseconds that took, or -1.
  std::int64_t until_it_backs_off(std::int64_t at_most_ms = 20'000) {
    for (const std::int64_t from_ms = now_ms_; now_ms_ - from_ms < at_most_ms;) {
      if (!tick()) return now_ms_ - from_ms;
    }
    return -1;
  }
  /// Lets it back off and wait; milliseconds that took.
  std::int64_t until_it_goes_on() {
    const std::int64_t from_ms = now_ms_;
    while (!tick() && now_ms_ - from_ms < 60'000) {
    }
    return now_ms_ - from_ms;
  }
  void back_off_three_times_from(double x_m) {
    drive_to(x_m);
    for (int time = 0; time < 3; ++time) {
      EXPECT_GT(until_it_backs_off(), 0);
      until_it_goes_on();
      pose_.y_m = 0.0;
      drive_to(x_m);
    }
  }
  /// Walls along the way, to its left and its right, as the robot sees them.
  [[nodiscard]] std::vector<Eigen::Vector2d> points_m() const {
    std::vector<Eigen::Vector2d> points;
    const Pose2 robot = inverse(pose_);
    for (double x_m = -2.0; x_m < 8.0; x_m += 0.05) {
      for (const double y_m : walls_m_) {
        const Pose2 point = robot * Pose2{x_m, y_m, 0.0};
        points.emplace_back(point.x_m, point.y_m);
      }
    }
    return points;
  }

  GiveWay state_;
  Body body_{.outline = Outline{.radius_m = 0.35}};
  std::vector<double> walls_m_;
  bool somebody_moves_ = false;
  std::optional<std::int64_t> obstacle_moved_ms_;
  Pose2 pose_;
  std::int64_t now_ms_ = 1'000'000;
};

TEST_F(GiveWayTest, WhoGetsOnBacksOffNever) {
  for (; pose_.x_m < 5.0; pose_.x_m += 0.008) ASSERT_TRUE(tick());
}

TEST_F(GiveWayTest, WhoOnlyTurnsToAndFroBacksOffToo) {
  drive_to(2.0);
  bool backed_off = false;
  for (int k = 0; k < 100 && !backed_off; ++k) {
    pose_.theta_rad = std::sin(0.3 * k);
    pose_.x_m = 2.0 + 0.1 * std::sin(0.1 * k);
    backed_off = !tick();
  }
  EXPECT_TRUE(backed_off);
}

TEST_F(GiveWayTest, BacksOffAlongTheWayItCameWaitsAndGoesOn) {
  drive_to(3.0);
  pose_.theta_rad = 1.0;  // whichever way it looks
  EXPECT_NEAR(static_cast<double>(until_it_backs_off()), 5000.0, 1200.0);
  EXPECT_LT(until_it_goes_on(), 12'000);
  EXPECT_NEAR(pose_.x_m, 1.8, 0.3);
  EXPECT_NEAR(pose_.y_m, 0.0, 0.01);
}

TEST_F(GiveWayTest, KeepsToTheCornersOfTheWayItCame) {
  drive_to(2.0);
  for (; pose_.y_m < 0.6; pose_.y_m += 0.03) tick();
  ASSERT_GT(until_it_backs_off(), 0);
  EXPECT_NEAR(state_.back_to_m.x(), 1.0, 0.15);
  EXPECT_NEAR(state_.back_to_m.y(), 0.0, 1e-9);
}

TEST_F(GiveWayTest, BacksOffThreeTimesFromOneThingAndThenStays) {
  back_off_three_times_from(3.0);
  EXPECT_EQ(until_it_backs_off(60'000), -1);
  forget_standing(state_);
  EXPECT_EQ(until_it_backs_off(60'000), -1);
}

TEST_F(GiveWayTest, SentOnFromThereItBacksOffOnceMore) {
  back_off_three_times_from(3.0);
  begin_way(state_);
  EXPECT_GT(until_it_backs_off(), 0);
  until_it_goes_on();
  drive_to(3.0);
  EXPECT_EQ(until_it_backs_off(60'000), -1);
}

TEST_F(GiveWayTest, BacksOffAgainFromAnotherThingFartherOn) {
  back_off_three_times_from(3.0);
  drive_to(6.0);
  EXPECT_GT(until_it_backs_off(), 0);
}

TEST_F(GiveWayTest, WhereItHasNotComeFromAnywhereItStays) {
  EXPECT_EQ(until_it_backs_off(60'000), -1);
  drive_to(0.3);
  EXPECT_EQ(until_it_backs_off(60'000), -1);
}

TEST_F(GiveWayTest, WhatIsBehindItEndsTheBackingOffInTime) {
  drive_to(3.0);
  ASSERT_GT(until_it_backs_off(), 0);
  const Pose2 blocked = pose_;
  const std::int64_t from_ms = now_ms_;
  do {
    pose_ = blocked;
  } while (!tick() && now_ms_ - from_ms < 60'000);
  EXPECT_LE(now_ms_ - from_ms, 11'000);
}

TEST_F(GiveWayTest, StandingForAReasonOfItsOwnIsNotBeingBlocked) {
  drive_to(3.0);
  for (int k = 0; k < 300; ++k) {
    ASSERT_TRUE(tick());
    if (k % 40 == 0) forget_standing(state_);
  }
}

TEST_F(GiveWayTest, ForSomebodyItPullsOverToTheNearerWall) {
  walls_m_ = {0.8, -1.2};
  drive_to(3.0);
  obstacle_moved_ms_ = now_ms_;
  pose_.theta_rad = 2.0;  // whichever way it looks
  ASSERT_GT(until_it_backs_off(), 0);
  EXPECT_NEAR(state_.back_to_m.x(), 1.8, 0.15);
  EXPECT_GT(state_.back_to_m.y(), 0.2);
  EXPECT_LT(state_.back_to_m.y(), 0.8 - 0.35 - 0.1);
}

TEST_F(GiveWayTest, ForAThingOrWhereThereIsRoomItDoesNotPullOver) {
  walls_m_ = {0.8, -1.2};
  drive_to(3.0);
  ASSERT_GT(until_it_backs_off(), 0);
  EXPECT_NEAR(state_.back_to_m.y(), 0.0, 1e-6);
  until_it_goes_on();
  walls_m_ = {0.8, -2.5};
  drive_to(6.0);
  obstacle_moved_ms_ = now_ms_;
  ASSERT_GT(until_it_backs_off(), 0);
  EXPECT_NEAR(state_.back_to_m.y(), 0.0, 1e-6);
}

TEST_F(GiveWayTest, WaitsWhileSomebodyWalksAboutAndNotForEver) {
  drive_to(3.0);
  ASSERT_GT(until_it_backs_off(), 0);
  somebody_moves_ = true;
  const std::int64_t long_ms = until_it_goes_on();
  EXPECT_GT(long_ms, 10'000);
  EXPECT_LT(long_ms, 25'000);
  somebody_moves_ = false;
  drive_to(3.0);
  ASSERT_GT(until_it_backs_off(), 0);
  EXPECT_LT(until_it_goes_on(), 12'000);
}

TEST_F(GiveWayTest, FromSomebodyItBacksOffMoreThanThreeTimesAndFartherEachTime) {
  drive_to(5.0);
  double before_m = 0.0;
  for (int time = 0; time < 5; ++time) {
    obstacle_moved_ms_ = now_ms_;
    ASSERT_GT(until_it_backs_off(), 0) << time;
    const double back_m = 5.0 - state_.back_to_m.x();
    EXPECT_GT(back_m, std::min(before_m + 0.4, 3.8)) << time;
    EXPECT_LT(back_m, 4.3);
    before_m = back_m;
    until_it_goes_on();
    drive_to(5.0);
  }
}

}  // namespace
}  // namespace homeward::driving::give_way_test
