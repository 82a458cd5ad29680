// SPDX-License-Identifier: Apache-2.0
#include "exploration/pose_graph.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace homeward::exploration {
namespace {

/// A square of four metres driven in sixteen steps, with a drift to the left.
struct DrivenSquare {
  std::vector<Pose2> truth;
  std::vector<Pose2> poses;
  std::vector<PoseLink> links;

  DrivenSquare() {
    Pose2 at;
    Pose2 believed;
    truth.push_back(at);
    poses.push_back(believed);
    for (int i = 0; i < 16; ++i) {
      const double turn_rad = i % 4 == 3 ? std::numbers::pi / 2.0 : 0.0;
      at = at * Pose2{1.0, 0.0, turn_rad};
      const Pose2 step{1.0, 0.0, turn_rad + 0.01};
      believed = believed * step;
      truth.push_back(at);
      poses.push_back(believed);
      links.push_back({i, i + 1, step, 0.02, 0.02, false});
    }
  }
  [[nodiscard]] double worst_m() const {
    double worst_m = 0.0;
    for (std::size_t i = 0; i < poses.size(); ++i)
      worst_m = std::max(worst_m, (position_m(poses[i]) - position_m(truth[i])).norm());
    return worst_m;
  }
};

TEST(PoseGraphTest, AClosedLoopTakesTheDriftOut) {
  DrivenSquare square;
  const double before_m = square.worst_m();
  square.links.push_back({0, 16, {}, 0.02, 0.01, true});
  settle(square.poses, square.links);
  EXPECT_GT(before_m, 0.25);
  EXPECT_LT(square.worst_m(), 0.2 * before_m);
  EXPECT_LT(strain(square.poses, square.links.back()), 2.0);
  EXPECT_EQ(square.poses.front().x_m, 0.0) << "the first one is held";
}

TEST(PoseGraphTest, AWrongLoopHardlyMovesAnythingAndIsStrained) {
  DrivenSquare square;
  square.links.push_back({0, 16, {}, 0.02, 0.01, true});
  settle(square.poses, square.links);
  const double before_m = square.worst_m();
  square.links.push_back({2, 10, {0.5, 0.0, 0.0}, 0.02, 0.01, true});
  settle(square.poses, square.links);
  EXPECT_LT(square.worst_m(), before_m + 0.1);
  EXPECT_GT(strain(square.poses, square.links.back()), 50.0);
}

TEST(PoseGraphTest, WhatHasNoLinksStaysAsItIs) {
  std::vector<Pose2> poses = {{1.0, 2.0, 3.0}, {4.0, 5.0, 0.5}};
  settle(poses, {});
  EXPECT_EQ(poses[1].x_m, 4.0);
  std::vector<Pose2> none;
  settle(none, {});
  EXPECT_TRUE(none.empty());
}

}  // namespace
}  // namespace homeward::exploration
