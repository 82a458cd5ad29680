// SPDX-License-Identifier: Apache-2.0
#include "driving/pursuit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/pose2.hpp"

namespace homeward::driving::pursuit_test {
namespace {

using Points = std::vector<Eigen::Vector2d>;

Points wall(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m) {
  Points points;
  for (double share = 0.0; share <= 1.0; share += 0.01) points.emplace_back(from_m + share * (to_m - from_m));
  return points;
}

TEST(Pursuit, DrivesStraightToAGoalAheadAtTheSpeedAskedFor) {
  const auto motion = pursue({}, {}, {3.0, 0.0}, 0.4);
  ASSERT_TRUE(motion);
  EXPECT_DOUBLE_EQ(motion->speed_mps, 0.4);
  EXPECT_DOUBLE_EQ(motion->turn_radps, 0.0);
}

TEST(Pursuit, SharperArcsAreDrivenSlower) {
  double before_mps = 1.0;
  for (const double aside_m : {0.0, 0.15, 0.3}) {
    const auto motion = pursue({}, {}, {0.5, aside_m}, 0.5);
    ASSERT_TRUE(motion) << aside_m;
    EXPECT_LE(motion->speed_mps, before_mps);
    EXPECT_GE(motion->speed_mps, 0.1);
    before_mps = motion->speed_mps;
  }
  EXPECT_LT(before_mps, 0.45);
}

TEST(Pursuit, ComesToTheGoalAlongItsArcs) {
  const Eigen::Vector2d goal_m(2.5, 0.9);
  Pose2 pose;
  double nearest_m = 10.0;
  double last_turn_radps = 0.0;
  double largest_change_radps = 0.0;
  for (int i = 0; i < 200; ++i) {
    const Pose2 left = inverse(pose) * Pose2{goal_m.x(), goal_m.y(), 0.0};
    nearest_m = std::min(nearest_m, std::hypot(left.x_m, left.y_m));
    if (nearest_m < 0.1) break;
    const auto motion = pursue({}, {}, {left.x_m, left.y_m}, 0.4);
    ASSERT_TRUE(motion) << i;
    if (i > 0) largest_change_radps = std::max(largest_change_radps, std::abs(motion->turn_radps - last_turn_radps));
    last_turn_radps = motion->turn_radps;
    const double turned_rad = 0.1 * motion->turn_radps;
    pose = pose * Pose2{0.1 * motion->speed_mps * std::cos(0.5 * turned_rad),
                        0.1 * motion->speed_mps * std::sin(0.5 * turned_rad), turned_rad};
  }
  EXPECT_LT(nearest_m, 0.1);
  EXPECT_LT(largest_change_radps, 0.05);
}

TEST(Pursuit, AGoalAsideOrBehindIsNotDrivenTo) {
  EXPECT_FALSE(pursue({}, {}, {0.5, 1.0}, 0.4));
  EXPECT_FALSE(pursue({}, {}, {-1.0, 0.0}, 0.4));
}

TEST(Pursuit, LeavesAWayWithLittleRoomToTheSearch) {
  const Body disc;
  Points doorway = wall({1.0, 0.5}, {1.0, 2.0});
  const Points right = wall({1.0, -0.5}, {1.0, -2.0});
  doorway.insert(doorway.end(), right.begin(), right.end());
  EXPECT_FALSE(pursue(disc, doorway, {2.0, 0.0}, 0.4));             // 1.0 m wide: 0.15 m to each side
  EXPECT_TRUE(pursue(disc, doorway, {0.3, 0.0}, 0.4));              // before it there is room
  EXPECT_FALSE(pursue(disc, Points{{1.2, 0.1}}, {2.0, 0.0}, 0.4));  // a post in the way
  EXPECT_TRUE(pursue(disc, Points{{2.9, 0.1}}, {2.0, 0.0}, 0.4));   // one beyond the goal
  EXPECT_TRUE(pursue(disc, Points{{1.2, 0.6}}, {2.0, 0.0}, 0.4));   // one beside the way
}

}  // namespace
}  // namespace homeward::driving::pursuit_test
