// SPDX-License-Identifier: Apache-2.0
#include "driving/way_following.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace homeward::driving::way_following_test {
namespace {

using Points = std::vector<Eigen::Vector2d>;

void add_wall(Points& points, const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m) {
  for (double share = 0.0; share <= 1.0; share += 0.005) points.emplace_back(from_m + share * (to_m - from_m));
}

/// A wall across x = 1.5 m, 0.1 m thick, with a door of 0.85 m about y.
Points narrow_door(double middle_y_m) {
  Points points;
  for (const double x_m : {1.5, 1.6}) {
    add_wall(points, {x_m, middle_y_m + 0.425}, {x_m, 3.0});
    add_wall(points, {x_m, middle_y_m - 0.425}, {x_m, -3.0});
  }
  return points;
}

std::vector<Pose2> straight_way() {
  std::vector<Pose2> way;
  for (int i = 0; i <= 40; ++i) way.push_back({0.1 * i, 0.0, 0.0});
  return way;
}

/// Two metres radius, to the left.
std::vector<Pose2> bend() {
  std::vector<Pose2> way;
  for (int i = 0; i <= 40; ++i) {
    const double turned_rad = 0.05 * i;
    way.push_back({2.0 * std::sin(turned_rad), 2.0 * (1.0 - std::cos(turned_rad)), turned_rad});
  }
  return way;
}

struct Driven {
  Pose2 pose;
  double most_beside_m = 0.0;  // after the first metre
  double clearance_m = 1e9;
  bool followed = true;
};

/// Drives by the law alone for some seconds, all in the frame that the way is given in.
Driven drive(Pose2 pose, const Points& points_m, const std::vector<Pose2>& way, double seconds) {
  const Body body;
  Driven driven{pose};
  double length_m = 0.0;
  std::size_t here = 0;
  for (double t_s = 0.0; t_s < seconds; t_s += 0.1) {
    const Pose2 back = inverse(pose);
    Points seen;
    for (const Eigen::Vector2d& point : points_m) seen.push_back(position_m(back * Pose2{point.x(), point.y(), 0.0}));
    std::vector<Pose2> rest;
    double least_m = 1e9;
    for (std::size_t i = here; i < std::min(way.size(), here + 8); ++i) {
      const double off_m = position_m(back * way[i]).norm();
      if (off_m < least_m) here = i;
      least_m = std::min(least_m, off_m);
    }
    if (here + 3 >= way.size()) break;
    for (std::size_t i = here == 0 ? 0 : here - 1; i < way.size(); ++i) rest.push_back(back * way[i]);
    const auto motion = follow_way(body, seen, rest, 0.3);
    driven.followed = motion.has_value();
    if (!motion) break;
    const double turned_rad = 0.1 * motion->turn_radps;
    const double step_m = 0.1 * motion->speed_mps;
    pose = pose * Pose2{step_m * std::cos(0.5 * turned_rad), step_m * std::sin(0.5 * turned_rad), turned_rad};
    length_m += step_m;
    driven.clearance_m = std::min(driven.clearance_m, clearance_m(body, seen));
    if (length_m > 1.0) driven.most_beside_m = std::max(driven.most_beside_m, std::min(least_m, 1.0));
  }
  driven.pose = pose;
  return driven;
}

TEST(WayFollowing, ComesBackToAStraightWayAndKeepsToIt) {
  const Driven driven = drive({0.0, 0.2, 0.1}, {}, straight_way(), 10.0);
  EXPECT_TRUE(driven.followed);
  EXPECT_GT(driven.pose.x_m, 2.0);
  EXPECT_NEAR(driven.pose.y_m, 0.0, 0.01);
  EXPECT_NEAR(driven.pose.theta_rad, 0.0, 0.03);
}

TEST(WayFollowing, DoesNotCutABend) {
  const Driven driven = drive({}, {}, bend(), 10.0);
  EXPECT_TRUE(driven.followed);
  EXPECT_GT(driven.pose.y_m, 0.8);
  EXPECT_NEAR(std::hypot(driven.pose.x_m, driven.pose.y_m - 2.0), 2.0, 0.02) << "from the middle of the bend";
}

TEST(WayFollowing, PassesADoorThatLeavesSevenCentimetresOnEachSide) {
  const Driven driven = drive({0.0, 0.1, -0.1}, narrow_door(0.0), straight_way(), 12.0);
  EXPECT_TRUE(driven.followed);
  EXPECT_GT(driven.pose.x_m, 2.5);
  EXPECT_GE(driven.clearance_m, 0.06);
}

TEST(WayFollowing, WhereTheWayLeadsPastOneSideOfADoorItKeepsToItsMiddle) {
  const Driven driven = drive({}, narrow_door(0.04), straight_way(), 12.0);
  EXPECT_TRUE(driven.followed);
  EXPECT_GT(driven.pose.x_m, 2.5);
  EXPECT_GE(driven.clearance_m, 0.055) << "0.035 m on the way itself";
}

TEST(WayFollowing, LeavesAWayThatIsShutOrFarOffOrTurnedAwayFromToASearch) {
  Points wall;
  add_wall(wall, {0.8, -2.0}, {0.8, 2.0});
  const std::vector<Pose2> way = straight_way();
  EXPECT_TRUE(follow_way({}, {}, way, 0.3));
  EXPECT_FALSE(follow_way({}, wall, way, 0.3));
  std::vector<Pose2> aside = way;
  for (Pose2& pose : aside) pose.y_m += 0.7;
  EXPECT_FALSE(follow_way({}, {}, aside, 0.3));
  std::vector<Pose2> away;
  for (const Pose2& pose : way) away.push_back(Pose2{0.0, 0.0, 1.5} * pose);
  EXPECT_FALSE(follow_way({}, {}, away, 0.3));
  EXPECT_FALSE(follow_way({}, {}, std::vector<Pose2>{{}}, 0.3));
  EXPECT_FALSE(follow_way({}, {}, std::vector<Pose2>{}, 0.3));
}

}  // namespace
}  // namespace homeward::driving::way_following_test
