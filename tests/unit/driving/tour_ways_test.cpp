// SPDX-License-Identifier: Apache-2.0
#include "driving/tour_ways.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "driving/scan.hpp"
#include "support/walled_floor.hpp"

namespace homeward::driving::tour_ways_test {
namespace {

using homeward::testing::sweep_at;
using homeward::testing::Wall;

/// A corridor along x, 2 m wide, with a door of 0.9 m on its left at `door_x_m`, and walls behind the door.
std::vector<Wall> corridor(double door_x_m) {
  return {{{-10.0, -1.0}, {10.0, -1.0}},
          {{-10.0, 1.0}, {door_x_m - 0.45, 1.0}},
          {{door_x_m + 0.45, 1.0}, {10.0, 1.0}},
          {{door_x_m - 2.0, 4.0}, {door_x_m + 2.0, 4.0}}};
}

/// Along the corridor, and at `door_x_m` through the door.
std::vector<TourWay> ways(double door_x_m) {
  std::vector<TourWay> all;
  for (int k = -6; k < 6; ++k) all.push_back({{k, 0.0}, {k + 1.0, 0.0}});
  all.push_back({{door_x_m, 0.0}, {door_x_m, 1.2}});
  all.push_back({{door_x_m, 1.2}, {door_x_m, 2.4}});
  return all;
}

PoseHypothesis at(const Pose2& pose, double spread_m = 0.04, double spread_rad = 0.02) {
  PoseHypothesis one;
  one.map_from_robot = pose;
  one.covariance.diagonal() << spread_m * spread_m, spread_m * spread_m, spread_rad * spread_rad;
  one.weight = 0.4;
  return one;
}

std::optional<double> room_m(double door_seen_m, double door_driven_m, const PoseHypothesis& hypothesis) {
  const auto points_m = hit_points(sweep_at({0.0, 0.2, 0.3}, corridor(door_seen_m)));
  return room_on_ways_m(points_m, ways(door_driven_m), hypothesis);
}

TEST(TourWays, ThroughTheDoorThatIsSeenNothingStandsOnAWay) { EXPECT_GT(room_m(2.0, 2.0, at({0.0, 0.2, 0.3})), 0.4); }

TEST(TourWays, WhereThereIsAWallInsteadOfTheDoorItIsBarred) { EXPECT_LT(room_m(-2.0, 2.0, at({0.0, 0.2, 0.3})), 0.25); }

TEST(TourWays, WhatIsHiddenBarsNothing) {
  // The wall of another room crosses a way that is not seen from here.
  std::vector<TourWay> behind = {{{2.0, 3.0}, {2.0, 6.0}}, {{-3.0, 1.5}, {-3.0, 3.0}}};
  const auto points_m = hit_points(sweep_at({0.0, 0.0, 0.0}, corridor(8.0)));
  EXPECT_GT(room_on_ways_m(points_m, behind, at({})), 0.45);
}

TEST(TourWays, ThePostOfASignIsNoWall) {
  std::vector<Wall> walls = corridor(2.0);
  walls.push_back({{3.0, -0.02}, {3.0, 0.02}});
  const auto points_m = hit_points(sweep_at({0.0, 0.2, 0.3}, walls));
  EXPECT_GT(room_on_ways_m(points_m, ways(2.0), at({0.0, 0.2, 0.3})), 0.4);
}

TEST(TourWays, ThePoseThatIsDoubtedLeavesMoreRoom) {
  const auto known_m = room_m(-2.0, 2.0, at({0.0, 0.2, 0.3}));
  const auto doubted_m = room_m(-2.0, 2.0, at({0.0, 0.2, 0.3}, 1.0, 0.1));
  ASSERT_TRUE(known_m);
  EXPECT_GT(doubted_m, *known_m + 0.29);
}

TEST(TourWays, WithoutWaysOrPointsNothingIsKnownAndFarFromAllThereIsRoom) {
  const auto points_m = hit_points(sweep_at({}, corridor(2.0)));
  EXPECT_FALSE(room_on_ways_m({}, ways(2.0), at({})));
  EXPECT_FALSE(room_on_ways_m(points_m, {}, at({})));
  EXPECT_FALSE(room_on_ways_m(points_m, ways(2.0), at({40.0, 0.0, 0.0}))) << "no way is near";
  const std::vector<TourWay> aside = {{{-3.0, -3.5}, {-3.0, -5.0}}};
  EXPECT_EQ(room_on_ways_m(points_m, aside, at({})), 1.0) << "nothing that is seen is near it";
}

/// Two places that pictures do not tell apart: here, with the door at x = 2 m, and 30 m on, where it is at x = 28 m.
struct Twins {
  Twins() {
    for (TourWay way : ways(2.0)) all_ways.push_back(way);
    for (TourWay way : ways(-2.0)) {
      way.from_m.x() += 30.0;
      way.to_m.x() += 30.0;
      all_ways.push_back(way);
    }
  }
  PoseHypotheses hypotheses{{}, {at({0.0, 0.2, 0.3}), at({30.0, 0.2, 0.3})}, 0.2, 0.0};
  std::vector<TourWay> all_ways;
};

TEST(WeighByWays, OfTwoTwinsTheOneWinsWhoseDoorIsWhereItIsSeen) {
  const auto points_m = hit_points(sweep_at({0.0, 0.2, 0.3}, corridor(2.0)));
  Twins twins;
  for (int k = 0; k < 3; ++k) weigh_by_ways(twins.hypotheses, points_m, twins.all_ways, 1.0);
  ASSERT_NE(twins.hypotheses.best(), nullptr);
  EXPECT_EQ(twins.hypotheses.best()->map_from_robot.x_m, 0.0);
  EXPECT_GT(twins.hypotheses.best_probability(), 0.8);
  EXPECT_LT(twins.hypotheses.probability_within({30.0, 0.2}, 1.0), 0.002);
}

TEST(WeighByWays, ASweepThatSaysNothingNewChangesNothing) {
  const auto points_m = hit_points(sweep_at({0.0, 0.2, 0.3}, corridor(2.0)));
  Twins twins;
  weigh_by_ways(twins.hypotheses, points_m, twins.all_ways, 0.0);
  EXPECT_NEAR(twins.hypotheses.best_probability(), 0.4, 1e-9);
  EXPECT_NEAR(twins.hypotheses.elsewhere(), 0.2, 1e-9);
}

TEST(WeighByWays, WhereEveryHypothesisIsBarredItIsMoreProbablyElsewhere) {
  const auto points_m = hit_points(sweep_at({0.0, 0.2, 0.3}, corridor(7.0)));
  Twins twins;
  weigh_by_ways(twins.hypotheses, points_m, twins.all_ways, 1.0);
  EXPECT_GT(twins.hypotheses.elsewhere(), 0.5);
  EXPECT_LT(twins.hypotheses.elsewhere(), 0.8) << "something may have been put there";
}

}  // namespace
}  // namespace homeward::driving::tour_ways_test
