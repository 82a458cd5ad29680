// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "localisation/localiser.hpp"
#include "support/landmark_corridor.hpp"

namespace homeward::localisation::localiser_odometry_test {
namespace {

using homeward::testing::corridor;
using homeward::testing::seen_at;

/// The corridor with ways of a metre, as odometry measured them.
map::TopologicalMap measured_corridor(const std::vector<int>& alike = {}) {
  map::TopologicalMap map = corridor(alike);
  for (map::Edge& edge : map.edges) edge.length_from = map::LengthSource::kOdometry;
  return map;
}

std::string best(const Belief& belief) { return belief.top.front().place.str(); }

double probability_of(const Belief& belief, const std::string& place) {
  for (const PlaceProbability& at : belief.top) {
    if (at.place.str() == place) return at.probability;
  }
  return 0.0;
}

TEST(LocaliserWithOdometry, ThreeMetresOnIsThePlaceThreeMetresOn) {
  // D, E, F and G look the same.
  const map::TopologicalMap map = measured_corridor({3, 4, 5, 6});
  for (const auto& [driven_m, place] : {std::pair(1.0, "D"), std::pair(2.0, "E"), std::pair(3.0, "F")}) {
    Localiser localiser(map, {});
    localiser.update(seen_at(2, 0.05, 0.0), Pose2{10.0, 5.0, 0.3});
    const Belief belief = localiser.update(seen_at(3, 0.05, 0.0), Pose2{10.0, 5.0 - driven_m, 0.3});
    EXPECT_EQ(best(belief), place) << driven_m;
    EXPECT_GT(belief.top.front().probability, 1.2 * belief.top[1].probability) << driven_m;
  }
  // Without it, the nearest one is always the likeliest.
  Localiser without(map, {});
  without.update(seen_at(2, 0.05, 0.0));
  EXPECT_EQ(best(without.update(seen_at(3, 0.05, 0.0))), "D");
}

TEST(LocaliserWithOdometry, HearsWhichOfTwoLookAlikesItIsFromTheRobotThatDroveThere) {
  const map::TopologicalMap map = measured_corridor({2, 7});  // C and H look the same
  Localiser localiser(map, {});
  localiser.update(seen_at(2, 0.05, 0.0), Pose2{});
  const Belief belief = localiser.apply_estimate(PlaceId("H"), 0.95);
  EXPECT_EQ(best(belief), "H");
  EXPECT_GT(probability_of(belief, "H"), 0.8);
  EXPECT_LE(belief.near_share, 0.95 + 1e-9);
  Localiser unsure(map, {});
  const Belief before = unsure.update(seen_at(2, 0.05, 0.0), Pose2{});
  EXPECT_EQ(probability_of(unsure.apply_estimate(PlaceId("H"), 0.89), "H"), probability_of(before, "H"));
  EXPECT_EQ(probability_of(unsure.apply_estimate(PlaceId("nowhere"), 1.0), "H"), probability_of(before, "H"));
}

TEST(LocaliserWithOdometry, WhatItHearsDoesNotOutweighPicturesThatAreClear) {
  Localiser localiser(measured_corridor(), {});
  Belief belief;
  for (int k = 0; k < 6; ++k) {
    localiser.update(seen_at(3, 0.1 * k, 0.0), Pose2{0.5 * k, 0.0, 0.0});
    belief = localiser.apply_estimate(PlaceId("I"), 0.97);
  }
  EXPECT_EQ(best(belief), "D");
}

TEST(LocaliserWithOdometry, StandingStillItHearsLess) {
  const map::TopologicalMap map = measured_corridor({2, 7});
  const auto after_standing = [&](int looks) {
    Localiser localiser(map, {});
    Belief belief = localiser.update(seen_at(1, 0.05, 0.0), Pose2{});
    belief = localiser.update(seen_at(2, 0.05, 0.0), Pose2{1.0, 0.0, 0.0});
    for (int k = 0; k < looks; ++k) {
      localiser.update(seen_at(2, 0.05, 0.0), Pose2{1.0, 0.0, 0.0});
      belief = localiser.apply_estimate(PlaceId("H"), 0.95);
    }
    return probability_of(belief, "C");
  };
  const double before = after_standing(0);
  ASSERT_GT(before, 0.9);
  EXPECT_GT(after_standing(1), 0.9);
  EXPECT_LT(after_standing(1), before);
}

TEST(LocaliserWithOdometry, UnderACoveredLensItHearsNothing) {
  Localiser localiser(measured_corridor(), {});
  localiser.update(seen_at(3, 0.05, 0.0), Pose2{});
  localiser.update(features::Appearance{}, Pose2{0.5, 0.0, 0.0});
  const Belief belief = localiser.apply_estimate(PlaceId("I"), 0.97);
  EXPECT_EQ(best(belief), "D");
  EXPECT_TRUE(belief.lost);
}

TEST(LocaliserWithOdometry, StandingStillNeitherMovesTheBeliefNorMakesItSurer) {
  const map::TopologicalMap map = measured_corridor({4, 5});  // E and F look the same
  Localiser standing(map, {});
  Localiser guessing(map, {});
  const Pose2 spot{-3.0, 2.0, 1.0};
  const Belief first = standing.update(seen_at(4, 0.3, 0.0), spot);
  guessing.update(seen_at(4, 0.3, 0.0));
  ASSERT_FALSE(first.lost);
  Belief last;
  Belief guessed;
  for (int i = 0; i < 50; ++i) {
    const double turned_rad = 0.05 * i;
    last = standing.update(seen_at(4, 0.3, turned_rad), spot * Pose2{0.001 * i, 0.0, turned_rad});
    guessed = guessing.update(seen_at(4, 0.3, turned_rad));
  }
  EXPECT_EQ(last.updates, 51);
  EXPECT_EQ(last.near_share, first.near_share);
  EXPECT_EQ(best(last), best(first));
  EXPECT_EQ(last.top.front().probability, first.top.front().probability);
  EXPECT_GT(guessed.near_share, first.near_share);  // who knows nothing of the way takes each for a new one
}

TEST(LocaliserWithOdometry, CreepingOnArrivesAllTheSame) {
  Localiser localiser(measured_corridor(), {});
  Belief belief;
  for (int i = 0; i <= 60; ++i) {  // six metres, a tenth at a time
    const int scene = (i + 5) / 10;
    belief = localiser.update(seen_at(scene, 0.1 * i - scene, 0.0), Pose2{0.1 * i, 0.0, 0.0});
  }
  EXPECT_EQ(best(belief), "G");
  EXPECT_FALSE(belief.lost);
  EXPECT_GT(belief.near_share, 0.9);
}

TEST(LocaliserWithOdometry, FindsARobotThatWasCarriedOffWithoutItsWheelsTurning) {
  Localiser localiser(measured_corridor(), {});
  const Pose2 spot{1.0, 1.0, 0.0};
  for (int i = 0; i < 4; ++i) localiser.update(seen_at(1, 0.02, 0.0), spot);
  Belief belief;
  int updates = 0;
  do {
    belief = localiser.update(seen_at(8, 0.02, 1.0), spot);
    ++updates;
  } while (updates < 6 && (belief.lost || best(belief) != "I"));
  EXPECT_LE(updates, 3);
  EXPECT_FALSE(belief.lost);
}

TEST(LocaliserWithOdometry, KeepsLookingWhereItIsLost) {
  Localiser localiser(measured_corridor({1, 3, 5, 7}), {});  // four that look the same, none beside another
  const Belief first = localiser.update(seen_at(1, 0.05, 0.0), Pose2{});
  ASSERT_TRUE(first.lost);
  const Belief second = localiser.update(seen_at(1, 0.05, 0.0), Pose2{});
  EXPECT_NE(second.near_share, first.near_share);
}

TEST(LocaliserWithOdometry, ANewCountOfOdometryKeepsTheBeliefAndForgetsTheWay) {
  const map::TopologicalMap map = measured_corridor({4, 7});
  Localiser restarted(map, {});
  Localiser other(map, {});
  for (Localiser* localiser : {&restarted, &other}) localiser->update(seen_at(3, 0.05, 0.0), Pose2{4.0, 0.0, 0.0});
  restarted.restart_odometry();
  // The count begins at zero again: to one who was not told, that is a drive of four metres.
  const Belief next = restarted.update(seen_at(4, 0.05, 0.0), Pose2{});
  EXPECT_EQ(next.updates, 2);
  EXPECT_EQ(best(next), "E");
  EXPECT_GT(next.top.front().probability, 0.9);
  const Belief misled = other.update(seen_at(4, 0.05, 0.0), Pose2{});
  EXPECT_EQ(best(misled), "H");
  EXPECT_GT(probability_of(next, "E"), probability_of(misled, "E"));
  // From here on the new count tells the way.
  EXPECT_EQ(best(restarted.update(seen_at(5, 0.05, 0.0), Pose2{1.0, 0.0, 0.0})), "F");
}

TEST(LocaliserWithOdometry, APictureWithoutOdometryIsAsBefore) {
  Localiser with(measured_corridor(), {});
  Localiser without(measured_corridor(), {});
  with.update(seen_at(2, 0.05, 0.0), Pose2{7.0, 0.0, 0.0});
  without.update(seen_at(2, 0.05, 0.0));
  const Belief gap = with.update(seen_at(3, 0.05, 0.0));
  const Belief same = without.update(seen_at(3, 0.05, 0.0));
  EXPECT_EQ(gap.near_share, same.near_share);
  // And the way from it is not known either.
  const Belief after = with.update(seen_at(4, 0.05, 0.0), Pose2{7.0, 0.0, 0.0});
  EXPECT_EQ(after.near_share, without.update(seen_at(4, 0.05, 0.0)).near_share);
}

TEST(LocaliserWithOdometry, AWildJumpOfOdometrySaysNothing) {
  Localiser with(measured_corridor(), {});
  Localiser without(measured_corridor(), {});
  with.update(seen_at(2, 0.05, 0.0), Pose2{});
  without.update(seen_at(2, 0.05, 0.0));
  EXPECT_EQ(with.update(seen_at(3, 0.05, 0.0), Pose2{5000.0, 0.0, 0.0}).near_share,
            without.update(seen_at(3, 0.05, 0.0)).near_share);
}

TEST(LocaliserWithOdometry, ADriveUnderACoveredLensCounts) {
  const map::TopologicalMap map = measured_corridor({3, 4, 5, 6});
  Localiser localiser(map, {});
  localiser.update(seen_at(2, 0.05, 0.0), Pose2{});
  for (int i = 1; i <= 30; ++i) EXPECT_TRUE(localiser.update({}, Pose2{0.1 * i, 0.0, 0.0}).lost);
  EXPECT_EQ(best(localiser.update(seen_at(3, 0.05, 0.0), Pose2{3.0, 0.0, 0.0})), "F");
}

}  // namespace
}  // namespace homeward::localisation::localiser_odometry_test
