// SPDX-License-Identifier: Apache-2.0
#include "exploration/companion.hpp"

#include <gtest/gtest.h>

#include "exploration/explorer.hpp"
#include "support/drawn_walls.hpp"

namespace homeward::exploration {
namespace {

ExplorerConfig coarse() {
  ExplorerConfig config;
  config.floor.cell_m = 0.1;
  return config;
}

/// A robot in two rooms whose floor has its first pose as origin; poses and points are those of the drawing.
struct Robot {
  explicit Robot(const Pose2& begins) : start(begins) { take(begins); }
  void take(const Pose2& pose) {
    now = pose;
    explorer.take(sweep_of(testing::two_rooms(), pose), odometry(), nullptr);
  }
  void take_all(double from_m, double to_m) {
    for (double x_m = from_m; x_m < to_m; x_m += 0.5) {
      for (double y_m = 0.7; y_m < 3.5; y_m += 0.5) {
        const bool in_box = x_m > 7.0 && x_m < 9.0 && y_m < 1.7;
        if (!in_box && std::abs(x_m - 5.0) >= 0.3) take({x_m, y_m, 0.0});
      }
    }
  }
  [[nodiscard]] Pose2 odometry() const { return inverse(start) * now; }
  [[nodiscard]] Eigen::Vector2d here(const Eigen::Vector2d& drawn_m) const {
    return position_m(inverse(start) * Pose2{drawn_m.x(), drawn_m.y(), 0.0});
  }
  [[nodiscard]] Reach reach() const { return explorer.reach(odometry()); }
  [[nodiscard]] std::optional<NextView> next() const { return explorer.next(reach(), std::nullopt); }
  [[nodiscard]] Eigen::Vector2d drawn(const Eigen::Vector2d& here_m) const {
    return position_m(start * Pose2{here_m.x(), here_m.y(), 0.0});
  }
  /// What this one tells `other`.
  [[nodiscard]] Companion to(const Robot& other, const std::optional<Eigen::Vector2d>& drives_to_m) const {
    CompanionReport report{shared_floor(explorer.floor(), explorer.coverage()), explorer.floor_from_robot(odometry()),
                           std::nullopt, true};
    if (drives_to_m) report.target_m = here(*drives_to_m);
    return {report, inverse(other.start) * start};
  }

  Pose2 start;
  Pose2 now;
  Explorer explorer{coarse()};
};

TEST(CompanionTest, WhatTheOthersPicturesCoverIsNotWanted) {
  Robot ours({1.0, 2.0, 0.3});
  Robot theirs({2.0, 2.0, -1.2});
  theirs.take_all(0.7, 9.6);
  ASSERT_TRUE(ours.next());
  ours.explorer.set_companion(theirs.to(ours, std::nullopt));
  EXPECT_FALSE(ours.next());
  EXPECT_FALSE(ours.explorer.waits_for_companion(ours.reach()));
}

TEST(CompanionTest, WhatOnlyTheOtherHasSeenIsDrivenOver) {
  Robot ours({1.0, 0.8, 0.3});
  ours.take_all(0.7, 4.6);
  Robot theirs({6.0, 2.0, 2.0});
  theirs.take({9.3, 2.6, 0.0});
  const Eigen::Vector2d there_m = ours.here({9.2, 0.6});
  ASSERT_FALSE(ours.reach().nearest(there_m)) << "behind the box, and never seen";
  ours.explorer.set_companion(theirs.to(ours, std::nullopt));
  EXPECT_TRUE(ours.reach().nearest(there_m));
}

TEST(CompanionTest, AroundTheOthersTargetNothingIsWantedWhileItDrives) {
  Robot ours({1.0, 2.0, 0.3});
  const auto alone = ours.next();
  ASSERT_TRUE(alone);
  const Eigen::Vector2d target_m = ours.drawn(alone->at_m);
  const Robot theirs({target_m.x(), target_m.y(), 1.0});
  Companion companion = theirs.to(ours, target_m);
  companion.report.floor = {};  // nobody has covered anything
  ours.explorer.set_companion(companion);
  const auto beside = ours.next();
  ASSERT_TRUE(beside);
  EXPECT_GT((beside->at_m - alone->at_m).norm(), ours.explorer.config().companion.around_target_m);
  companion.report.drives = false;
  ours.explorer.set_companion(companion);
  const auto left = ours.next();
  ASSERT_TRUE(left);
  EXPECT_LT((left->at_m - alone->at_m).norm(), 0.1);
}

TEST(CompanionTest, ATargetToWhichWeHaveClearlyLessToDriveStaysOurs) {
  Robot ours({1.0, 2.0, 0.3});
  const auto alone = ours.next();
  ASSERT_TRUE(alone);
  const Robot theirs({4.4, 2.0, 1.0});
  Companion companion = theirs.to(ours, ours.drawn(alone->at_m));
  companion.report.floor = {};
  ours.explorer.set_companion(companion);
  const auto beside = ours.next();
  ASSERT_TRUE(beside);
  EXPECT_LT((beside->at_m - alone->at_m).norm(), 1.0);
}

TEST(CompanionTest, WhatIsClearlyNearerToTheOtherIsLeftToItAsLongAsThereIsMore) {
  Robot ours({1.0, 2.0, 0.0});
  ours.take({4.0, 2.0, 0.0});
  ours.take({1.0, 2.0, 0.0});
  const Robot theirs({4.4, 2.0, 0.0});
  Companion companion = theirs.to(ours, std::nullopt);
  companion.report.floor = {};
  const ExploredFloor joint = joint_floor(ours.explorer.floor(), companion);
  const Reach reach = ours.reach();
  const auto is_left = [&](LeftToCompanion share, const Eigen::Vector2d& drawn_m) {
    std::vector<std::uint8_t> cells(joint.frame().size(), 0);
    mark_left(companion, share, joint, reach, {}, {}, cells);
    return cells[joint.frame().index(joint.frame().cell(ours.here(drawn_m)))] != 0;
  };
  EXPECT_TRUE(is_left(LeftToCompanion::kNearer, {4.0, 3.0}));
  EXPECT_FALSE(is_left(LeftToCompanion::kNearer, {1.2, 3.0}));
  EXPECT_FALSE(is_left(LeftToCompanion::kNearer, {2.7, 2.0})) << "as near to both";
  EXPECT_FALSE(is_left(LeftToCompanion::kTarget, {4.0, 3.0}));
}

TEST(CompanionTest, WithNothingLeftButTheOthersTargetItWaitsForThat) {
  Robot ours({1.0, 2.0, 0.3});
  ours.take_all(0.7, 4.6);
  ours.take({1.0, 2.0, 0.3});
  Robot theirs({5.6, 2.0, 0.0});
  theirs.take_all(5.6, 8.6);
  theirs.take({7.0, 2.4, 0.0});
  const Eigen::Vector2d last_m(9.2, 1.2);
  Companion companion = theirs.to(ours, last_m);
  ours.explorer.set_companion(companion);
  EXPECT_FALSE(ours.next());
  EXPECT_TRUE(ours.explorer.waits_for_companion(ours.reach()));
  companion.report.drives = false;
  ours.explorer.set_companion(companion);
  EXPECT_TRUE(ours.next());
}

}  // namespace
}  // namespace homeward::exploration
