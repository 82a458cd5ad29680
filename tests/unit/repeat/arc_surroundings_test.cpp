// SPDX-License-Identifier: Apache-2.0
#include "repeat/arc_surroundings.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/index.hpp"
#include "support/straight_path.hpp"

namespace homeward::repeat::arc_surroundings_test {
namespace {

using testing::StraightPath;

const Landmark* find(const ArcSurroundings& around, int feature) {
  for (const Landmark& landmark : around.landmarks) {
    if (landmark.feature == feature) return &landmark;
  }
  return nullptr;
}

/// Where a landmark is in the frame of the surroundings.
Eigen::Vector3d point_of(const Landmark& landmark) { return landmark.bearing / landmark.nearness; }

TEST(ArcSurroundings, JoinsArcsOfDifferentUnitsInTheUnitOfTheActualOne) {
  const StraightPath straight({0.0, 1.0, 1.5, 3.5});
  const ArcSurroundings around = surroundings_of(straight.path, 1, 1, 3);
  ASSERT_EQ(around.keys.size(), 4U);
  EXPECT_EQ(around.keys.front().key, 0);
  EXPECT_EQ(around.unit_arc, 1);
  // The arc is 0.5 m long.
  EXPECT_NEAR(around.key(0).position.x(), -2.0, 1e-9);
  EXPECT_NEAR(around.key(1).position.norm(), 0.0, 1e-9);
  EXPECT_NEAR(around.key(2).position.x(), 1.0, 1e-9);
  EXPECT_NEAR(around.key(3).position.x(), 5.0, 1e-9);
  for (std::size_t i = 0; i < straight.points_m.size(); ++i) {
    const Landmark* landmark = find(around, static_cast<int>(i));
    ASSERT_NE(landmark, nullptr);
    EXPECT_TRUE(landmark->has_distance);
    EXPECT_TRUE(landmark->in_arc);
    const Eigen::Vector3d expected = (straight.points_m[i] - Eigen::Vector3d(1.0, 0.0, 0.0)) / 0.5;
    EXPECT_LT((point_of(*landmark) - expected).norm(), 1e-6 * expected.norm());
  }
}

TEST(ArcSurroundings, ReachesNoFartherThanAskedAndNotPastACut) {
  StraightPath straight({0.0, 1.0, 1.5, 3.5});
  EXPECT_EQ(surroundings_of(straight.path, 1, 0, 3).keys.size(), 2U);
  straight.path.arcs.erase(straight.path.arcs.begin());  // the path is cut after the first key image
  const ArcSurroundings around = surroundings_of(straight.path, 0, 5, 3);
  EXPECT_EQ(around.keys.front().key, 1);
  EXPECT_EQ(around.keys.back().key, 3);
}

TEST(ArcSurroundings, GoOnRoundAClosedPathByTheScaleThere) {
  // As many metres an arc as its number and one; the last one leads from the last key image to the second, in any
  // unit: nothing says that the path comes out where it began.
  StraightPath straight({0.0, 1.0, 3.0, 6.0, 10.0, 15.0, 21.0, 28.0, 36.0, 45.0});
  TaughtPath& path = straight.path;
  path.key_images.pop_back();
  path.closing = PathClosing{1, 20, NodeScale{0.5, 20, 0.01}};
  const ArcSurroundings at_end = surroundings_of(path, 8, 2, 3);
  EXPECT_EQ(at_end.arcs, (std::vector<int>{6, 7, 8, 1, 2}));
  std::vector<int> keys;
  for (const KeyPose& key : at_end.keys) keys.push_back(key.key);
  EXPECT_EQ(keys, (std::vector<int>{6, 7, 8, 1, 2, 3}));
  EXPECT_NEAR(*at_end.units[3], 0.5, 1e-9);
  EXPECT_NEAR(at_end.key(2).position.x(), 1.5, 1e-6);
  EXPECT_EQ(at_end.next_key(8)->key, 1);
  EXPECT_EQ(at_end.next_key(3), nullptr);
  EXPECT_FALSE(at_end.has_key(4));
  const ArcSurroundings at_begin = surroundings_of(path, 1, 2, 3);
  EXPECT_EQ(at_begin.arcs, (std::vector<int>{7, 8, 1, 2, 3}));
  EXPECT_NEAR(*at_begin.units[1], 2.0, 1e-9);
  // The way in is before where it is closed, and leads on into the round.
  EXPECT_EQ(surroundings_of(path, 0, 2, 3).arcs, (std::vector<int>{0, 1, 2}));
}

TEST(ArcSurroundings, HaveEachKeyImageOnceHoweverShortTheRound) {
  StraightPath straight({0.0, 1.0, 2.0, 3.0, 4.0});
  TaughtPath& path = straight.path;
  path.key_images.pop_back();
  path.closing = PathClosing{0, 20, NodeScale{1.0, 20, 0.01}};
  for (int arc = 0; arc < 4; ++arc) {
    const ArcSurroundings around = surroundings_of(path, arc, 3, 3);
    std::vector<int> keys;
    for (const KeyPose& key : around.keys) keys.push_back(key.key);
    std::ranges::sort(keys);
    EXPECT_EQ(keys, (std::vector<int>{0, 1, 2, 3})) << arc;
    ASSERT_NE(around.next_key(path.arcs[at(arc)].from), nullptr);
    EXPECT_EQ(around.next_key(path.arcs[at(arc)].from)->key, path.to_key(path.arcs[at(arc)]));
  }
}

TEST(ArcSurroundings, ATurnOnTheSpotHasTheUnitOfTheArcBefore) {
  StraightPath straight({0.0, 1.0, 1.0, 3.0});
  straight.turn_at(1, 0.4);
  const ArcSurroundings around = surroundings_of(straight.path, 1, 1, 3);
  EXPECT_EQ(around.unit_arc, 0);
  EXPECT_NEAR(around.key(0).position.x(), -1.0, 1e-9);
  EXPECT_NEAR(around.key(2).position.norm(), 0.0, 1e-9);
  // The arc after it is joined by landmarks that both sides have in common.
  ASSERT_TRUE(around.units.back());
  EXPECT_NEAR(*around.units.back(), 2.0, 1e-6);
  EXPECT_TRUE(around.key(3).is_placed);
  // With too few of them it is not, and its own landmarks have no distance.
  const ArcSurroundings apart = surroundings_of(straight.path, 1, 1, 1000);
  EXPECT_FALSE(apart.units.back());
  EXPECT_FALSE(apart.key(3).is_placed);
}

TEST(ArcSurroundings, WithoutAnyBaselineThereIsNoUnit) {
  StraightPath straight({0.0, 0.0});
  straight.turn_at(0, 0.4);
  const ArcSurroundings around = surroundings_of(straight.path, 0, 2, 3);
  EXPECT_FALSE(around.unit_arc);
  EXPECT_EQ(around.nearness, 0.0);
  for (const Landmark& landmark : around.landmarks) EXPECT_FALSE(landmark.has_distance);
}

TEST(ArcSurroundings, DoubtfulArcsSayLessOfDistances) {
  StraightPath straight({0.0, 1.0});
  const ArcSurroundings sure = surroundings_of(straight.path, 0, 0, 3);
  straight.path.arcs.front().lead = 1.0;
  const ArcSurroundings doubtful = surroundings_of(straight.path, 0, 0, 3);
  EXPECT_GT(doubtful.landmarks.front().nearness_spread, 5.0 * sure.landmarks.front().nearness_spread);
}

}  // namespace
}  // namespace homeward::repeat::arc_surroundings_test
