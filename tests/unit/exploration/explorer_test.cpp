// SPDX-License-Identifier: Apache-2.0
#include "exploration/explorer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "support/drawn_walls.hpp"

namespace homeward::exploration {
namespace {

/// Drives along points with wheels that turn left by themselves, and takes pictures as the explorer wants them.
class DrivenExplorer {
 public:
  DrivenExplorer(std::vector<testing::DrawnWall> walls, const Pose2& start, double drift_rad_per_m,
                 const ExplorerConfig& config = {})
      : explorer(config), walls_(std::move(walls)), start_(start), truth_(start), drift_rad_per_m_(drift_rad_per_m) {
    explorer.take(sweep_of(walls_, truth_), odometry_, nullptr);
  }

  void drive_to(const Eigen::Vector2d& to_m) {
    constexpr double kStep_m = 0.05;
    const double heading_rad = std::atan2(to_m.y() - truth_.y_m, to_m.x() - truth_.x_m);
    move({0.0, 0.0, wrap_angle(heading_rad - truth_.theta_rad)});
    while ((position_m(truth_) - to_m).norm() > kStep_m) move({kStep_m, 0.0, 0.0});
  }
  /// Pushed to the side without the wheels' counting it.
  void slip(double to_left_m) { truth_ = truth_ * Pose2{0.0, to_left_m, 0.0}; }
  [[nodiscard]] double error_m() const {
    const Pose2 believed = start_ * explorer.floor_from_robot(odometry_);
    return (position_m(believed) - position_m(truth_)).norm();
  }
  [[nodiscard]] double wheels_error_m() const { return (position_m(start_ * odometry_) - position_m(truth_)).norm(); }
  [[nodiscard]] const Pose2& odometry() const { return odometry_; }

  Explorer explorer;

 private:
  void move(const Pose2& step) {
    truth_ = truth_ * step;
    const double driven_m = std::hypot(step.x_m, step.y_m);
    odometry_ = odometry_ * Pose2{step.x_m * 1.01, step.y_m, step.theta_rad + drift_rad_per_m_ * driven_m};
    const RangeSweep sweep = sweep_of(walls_, truth_);
    explorer.see(sweep, odometry_);
    if (explorer.wants_picture(odometry_)) explorer.take(sweep, odometry_, nullptr);
  }

  std::vector<testing::DrawnWall> walls_;
  Pose2 start_;
  Pose2 truth_;
  Pose2 odometry_;
  double drift_rad_per_m_;
};

/// A hall whose lower wall has niches that are all alike, one each 0.8 m, from x = 4 m to 9.6 m; on the left everything
/// looks different.
std::vector<testing::DrawnWall> hall_with_niches() {
  std::vector<testing::DrawnWall> walls;
  testing::add_box(walls, 0.0, 0.0, 24.0, 20.0);
  for (int i = 0; i < 7; ++i) testing::add_box(walls, 4.0 + 0.8 * i, 0.0, 4.4 + 0.8 * i, 0.3);
  testing::add_box(walls, 0.0, 1.9, 0.3, 2.2);
  testing::add_box(walls, 0.0, 3.4, 0.5, 4.1);
  testing::add_box(walls, 0.0, 5.0, 0.2, 5.3);
  testing::add_box(walls, 1.5, 0.0, 1.8, 0.2);
  testing::add_box(walls, 2.5, 0.0, 2.6, 0.3);
  return walls;
}

const std::vector<Eigen::Vector2d> kRound = {{1.0, 0.7}, {8.9, 0.7}, {8.9, 3.3}, {1.0, 3.3}, {1.0, 0.7}, {4.0, 0.7}};

TEST(ExplorerTest, SweepsTakeTheDriftOfTheWheelsOut) {
  DrivenExplorer driven(testing::rooms_with_two_doors(), {1.0, 0.7, 0.0}, radians(1.0));
  for (const Eigen::Vector2d& point : kRound) driven.drive_to(point);
  EXPECT_GT(driven.wheels_error_m(), 0.5);
  EXPECT_LT(driven.error_m(), 0.06);
}

TEST(ExplorerTest, APlaceIsKnownAgainAfterAWayRound) {
  DrivenExplorer driven(testing::rooms_with_two_doors(), {1.0, 0.7, 0.0}, radians(1.0));
  for (const Eigen::Vector2d& point : kRound) driven.drive_to(point);
  const auto& known = driven.explorer.known_again();
  ASSERT_FALSE(known.empty());
  for (const KnownAgain& again : known) {
    EXPECT_GE(again.now - again.then, driven.explorer.config().loop_gap);
    EXPECT_FALSE(again.taken_back);
  }
}

TEST(ExplorerTest, WrongLoopsAreTakenBackOnceMoreOthersAgreeAgainstThem) {
  ExplorerConfig config;
  config.filter.farthest_m = 2.5;  // in the middle of the hall it goes by its wheels
  DrivenExplorer driven(hall_with_niches(), {1.2, 5.6, -std::numbers::pi / 2}, 0.0, config);
  const Explorer& explorer = driven.explorer;
  const auto next = [&] { return explorer.next(explorer.reach(driven.odometry()), std::nullopt); };
  const std::vector<Eigen::Vector2d> out_m = {{1.2, 1.2}, {10.0, 1.2}, {11.0, 7.0}, {5.8, 7.0}};
  for (const Eigen::Vector2d& to_m : out_m) driven.drive_to(to_m);
  driven.slip(0.7);
  driven.drive_to({5.8, 4.5});
  driven.slip(0.7);
  for (const Eigen::Vector2d& to_m : {Eigen::Vector2d(5.8, 1.2), Eigen::Vector2d(4.4, 1.2)}) driven.drive_to(to_m);
  // It takes itself to be at another niche, by loops that agree with each other.
  ASSERT_GT(driven.error_m(), 0.6);
  const KnownAgain wrong = explorer.known_again().back();
  ASSERT_FALSE(wrong.taken_back);
  const int layouts = explorer.layouts();
  ASSERT_TRUE(next());
  for (double x_m = -15.0; x_m < 30.0; x_m += 0.5)
    for (double y_m = -15.0; y_m < 30.0; y_m += 0.5) driven.explorer.give_up({x_m, y_m});
  ASSERT_FALSE(next());

  for (const Eigen::Vector2d& to_m : {Eigen::Vector2d(1.2, 1.2), Eigen::Vector2d(1.2, 5.6)}) driven.drive_to(to_m);
  EXPECT_LT(driven.error_m(), 0.05);
  EXPECT_GT(explorer.layouts(), layouts);
  EXPECT_TRUE(next()) << "what was given up by wrong loops is wanted again";
  EXPECT_FALSE(explorer.known_again().back().taken_back);
  const auto is_wrong = [&](const KnownAgain& known) { return known.now == wrong.now && known.then == wrong.then; };
  EXPECT_TRUE(std::ranges::find_if(explorer.known_again(), is_wrong)->taken_back);
}

TEST(ExplorerTest, PicturesAreWantedAsFarApartAsATourHasThem) {
  DrivenExplorer driven(testing::two_rooms(), {1.0, 2.0, 0.0}, 0.0);
  driven.drive_to({9.0, 2.0});
  EXPECT_NEAR(static_cast<double>(driven.explorer.views().size()), 8.0 / 0.4, 2.0);
  for (std::size_t i = 1; i < driven.explorer.poses().size(); ++i) {
    const double apart_m = (position_m(driven.explorer.poses()[i]) - position_m(driven.explorer.poses()[i - 1])).norm();
    EXPECT_NEAR(apart_m, 0.4, 0.06);
  }
}

TEST(ExplorerTest, WhatIsGivenUpIsNotWantedAgain) {
  DrivenExplorer driven(testing::two_rooms(), {1.0, 2.0, 0.0}, 0.0);
  const Reach reach = driven.explorer.reach(driven.odometry());
  const auto first = driven.explorer.next(reach, std::nullopt);
  ASSERT_TRUE(first);
  driven.explorer.give_up(first->at_m);
  const auto second = driven.explorer.next(reach, std::nullopt);
  ASSERT_TRUE(second);
  EXPECT_GT((second->at_m - first->at_m).norm(), 0.25);
}

TEST(ExplorerTest, NoWayLeadsPastWhereOneWasBlockedUntilItIsTriedAgain) {
  DrivenExplorer driven(testing::two_rooms(), {4.0, 2.0, 0.0}, 0.0);
  driven.drive_to({4.4, 2.0});
  const auto reaches_next_room = [&] {
    const Reach reach = driven.explorer.reach(driven.odometry());
    const FloorCell cell = reach.frame().cell({2.0, 0.0});  // 6 m, 2 m of the drawing
    return reach.frame().holds(cell) && reach.reaches(reach.frame().index(cell));
  };
  ASSERT_TRUE(reaches_next_room());
  for (double aside_m = -0.4; aside_m <= 0.4; aside_m += 0.2) driven.explorer.put_off({2.0, 0.0}, {1.0, aside_m});
  EXPECT_FALSE(reaches_next_room());
  EXPECT_TRUE(driven.explorer.try_blocked_again());
  EXPECT_TRUE(reaches_next_room());
  EXPECT_FALSE(driven.explorer.try_blocked_again());
}

TEST(ExplorerTest, AFenceKeepsTheWholeBodyOff) {
  DrivenExplorer driven(testing::two_rooms(), {1.0, 2.0, 0.0}, 0.0);
  driven.drive_to({3.0, 2.0});
  const auto reaches = [&](double x_m) {
    const Reach reach = driven.explorer.reach(driven.odometry());
    const FloorCell cell = reach.frame().cell({x_m, 0.0});
    return reach.reaches(reach.frame().index(cell));
  };
  ASSERT_TRUE(reaches(0.2));
  driven.explorer.set_fences({{{-1.0, -2.0}, {0.0, -2.0}, {0.0, 2.0}, {-1.0, 2.0}}});
  EXPECT_FALSE(reaches(0.2)) << "its side would be over the fence";
  EXPECT_TRUE(reaches(0.6));
  driven.explorer.set_fences({{{0.0, 0.0}, {5.0, 5.0}}});
  EXPECT_TRUE(reaches(0.6)) << "two corners fence nothing";
}

}  // namespace
}  // namespace homeward::exploration
