// SPDX-License-Identifier: Apache-2.0
#include "exploration/believed_loops.hpp"

#include <gtest/gtest.h>

namespace homeward::exploration {
namespace {

/// Forty steps ahead that nothing contradicts but loops.
struct Row {
  std::vector<Pose2> poses;
  std::vector<PoseLink> steps;
  std::vector<PoseLink> loops;
  std::vector<std::uint8_t> believed;

  explicit Row(double spread_m) {
    for (int i = 0; i < 40; ++i) {
      poses.push_back({0.4 * i, 0.0, 0.0});
      if (i > 0) steps.push_back({i - 1, i, {0.4, 0.0, 0.0}, spread_m, 0.02, false});
    }
  }
  /// As if the view `b` lay `off_m` to the left of where the steps say.
  void add_loop(int a, int b, double off_m) {
    loops.push_back({a, b, {0.4 * (b - a), off_m, 0.0}, 0.03, 0.01, true});
    believed.push_back(1);
  }
  SettledLoops settle(int since = 0) {
    SettledLoops settled = settle_loops(poses, steps, loops, believed, since);
    poses = settled.poses;
    believed = settled.believed;
    return settled;
  }
};

using Believed = std::vector<std::uint8_t>;

TEST(BelievedLoopsTest, ALoneLoopThatTheStepsExcludeIsNotBelieved) {
  Row row(0.002);
  row.add_loop(0, 39, 6.0);
  EXPECT_EQ(row.settle().believed, Believed{0});
  EXPECT_LT(std::abs(row.poses.back().y_m), 0.1);
}

TEST(BelievedLoopsTest, ThreeThatAgreeOverruleTheOneThatWasBelievedFirst) {
  Row row(0.12);
  row.add_loop(0, 30, 1.0);
  EXPECT_EQ(row.settle().believed, Believed{1});
  EXPECT_NEAR(row.poses[30].y_m, 1.0, 0.1);
  row.add_loop(0, 31, 0.0);
  EXPECT_EQ(row.settle().believed, (Believed{1, 0})) << "one stands against one";
  row.add_loop(1, 31, 0.0);
  EXPECT_EQ(row.settle().believed, (Believed{1, 0, 0}));
  row.add_loop(2, 31, 0.0);
  EXPECT_EQ(row.settle().believed, (Believed{0, 1, 1, 1}));
  EXPECT_LT(std::abs(row.poses[30].y_m), 0.1);
}

TEST(BelievedLoopsTest, WhatWasTakenBackLongAgoIsNotWeighedAnew) {
  Row row(0.12);
  row.add_loop(0, 30, 1.0);
  row.settle();
  for (int i = 0; i < 3; ++i) {
    row.add_loop(i, 31, 0.0);
    row.settle(32);
  }
  EXPECT_EQ(row.believed, (Believed{1, 0, 0, 0}));
}

TEST(BelievedLoopsTest, ManyWrongOnesDoNotOverruleStepsThatAreCertain) {
  Row row(0.002);
  for (int i = 0; i < 4; ++i) row.add_loop(i, 30 + i, 6.0);
  EXPECT_EQ(row.settle().believed, (Believed{0, 0, 0, 0}));
  EXPECT_LT(std::abs(row.poses[30].y_m), 0.1);
}

}  // namespace
}  // namespace homeward::exploration
