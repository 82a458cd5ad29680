// SPDX-License-Identifier: Apache-2.0
#include "exploration/next_view.hpp"

#include <gtest/gtest.h>

#include "support/drawn_walls.hpp"

namespace homeward::exploration {
namespace {

class NextViewTest : public ::testing::Test {
 protected:
  void take(const Pose2& pose) {
    const RangeSweep sweep = sweep_of(testing::two_rooms(), pose);
    floor_.see(sweep, geometry::surface_of(sweep), pose);
    coverage_.add(floor_, position_m(pose), config_);
  }
  [[nodiscard]] std::optional<NextView> next(const Eigen::Vector2d& from_m) const {
    const std::vector<std::uint8_t> none(floor_.frame().size(), 0);
    return next_view(floor_, Reach::from(floor_, from_m, {}), coverage_, none, std::nullopt, config_);
  }
  ExploredFloor floor_;
  Coverage coverage_;
  ViewConfig config_;
};

TEST_F(NextViewTest, APictureCoversWhatIsNearAndInSight) {
  take({4.6, 0.8, 0.0});
  EXPECT_TRUE(coverage_.covers({4.0, 1.2}));
  EXPECT_FALSE(coverage_.covers({5.4, 0.8})) << "behind the wall";
  EXPECT_FALSE(coverage_.covers({2.0, 0.8})) << "too far";
}

TEST_F(NextViewTest, WhatIsNearIsFinishedFirst) {
  take({1.0, 2.0, 0.0});
  const auto view = next({1.0, 2.0});
  ASSERT_TRUE(view);
  EXPECT_LT(view->at_m.x(), 5.0) << "this room before the next";
  EXPECT_GE(view->gain_m2, config_.least_gain_m2);
}

TEST_F(NextViewTest, TheNextRoomIsWantedOnceThisOneIsCovered) {
  for (double x_m = 0.7; x_m < 4.6; x_m += 0.6) {
    for (double y_m = 0.7; y_m < 3.5; y_m += 0.6) take({x_m, y_m, 0.0});
  }
  const auto view = next({2.0, 2.0});
  ASSERT_TRUE(view);
  EXPECT_GT(view->at_m.x(), 4.5);
}

TEST_F(NextViewTest, NothingIsWantedWhereAllIsCovered) {
  for (double x_m = 0.7; x_m < 9.6; x_m += 0.5) {
    for (double y_m = 0.7; y_m < 3.5; y_m += 0.5) {
      const bool in_box = x_m > 7.0 && x_m < 9.0 && y_m < 1.7;
      const bool in_wall = std::abs(x_m - 5.0) < 0.3;
      if (!in_box && !in_wall) take({x_m, y_m, 0.0});
    }
  }
  EXPECT_FALSE(next({2.0, 2.0}));
}

TEST_F(NextViewTest, WhatWasGivenUpIsNotWanted) {
  take({1.0, 2.0, 0.0});
  const std::vector<std::uint8_t> all(floor_.frame().size(), 1);
  EXPECT_FALSE(next_view(floor_, Reach::from(floor_, {1.0, 2.0}, {}), coverage_, all, std::nullopt, config_));
}

TEST_F(NextViewTest, ThePlaceDrivenToIsKeptUntilAnotherIsClearlyBetter) {
  take({2.5, 2.0, 0.0});
  const std::vector<std::uint8_t> none(floor_.frame().size(), 0);
  const Reach reach = Reach::from(floor_, {2.5, 2.0}, {});
  const auto best = next_view(floor_, reach, coverage_, none, std::nullopt, config_);
  ASSERT_TRUE(best);
  // The room is the same to both sides of its middle.
  const Eigen::Vector2d other(best->at_m.x(), 4.0 - best->at_m.y());
  const auto kept = next_view(floor_, reach, coverage_, none, other, config_);
  ASSERT_TRUE(kept);
  EXPECT_LT((kept->at_m - other).norm(), 0.05);
}

}  // namespace
}  // namespace homeward::exploration
