// SPDX-License-Identifier: Apache-2.0
#include "localisation/localiser.hpp"

#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "localisation/calibration.hpp"
#include "localisation/candidates.hpp"
#include "localisation/motion_model.hpp"
#include "support/ascii_map.hpp"
#include "support/planar_scene.hpp"
#include "support/sample_map.hpp"

namespace homeward::localisation::localiser_test {
namespace {

constexpr int kPlaces = 10;
constexpr int kLandmarks = 40;

/// Landmarks of place `scene`, each with its own descriptor, seen by a robot `offset_m` ahead of the place's centre.
features::Appearance seen_at(int scene, double offset_m, double heading_rad) {
  std::mt19937_64 random(static_cast<std::uint64_t>(scene) + 50);
  const auto points = homeward::testing::room_points(kLandmarks, random);
  auto seen = homeward::testing::random_appearance(kLandmarks, static_cast<unsigned>(scene) + 500);
  for (int i = 0; i < kLandmarks; ++i) {
    seen.sift.bearings.row(i) =
        homeward::testing::bearing_from({offset_m, 0.0, heading_rad}, points[static_cast<std::size_t>(i)])
            .cast<float>()
            .transpose();
  }
  return seen;
}

/// A corridor of places A to J in a row. Places in `alike` look like the first of them.
map::TopologicalMap corridor(const std::vector<int>& alike = {}) {
  map::TopologicalMap map = homeward::testing::ascii_map("A-B-C-D-E-F-G-H-I-J");
  for (int i = 0; i < kPlaces; ++i) {
    const bool copy = std::ranges::find(alike, i) != alike.end();
    map.places[static_cast<std::size_t>(i)].appearances = {seen_at(copy ? alike.front() : i, 0.0, 0.0)};
  }
  map.motion.hop_spread = 0.6;
  map.motion.distance_scale = 0.05;
  return map;
}

TEST(MotionModel, KeepsTheSumAndReachesAsFarAsItMay) {
  const map::PlaceGraph graph(corridor());
  const MotionModel model(graph, 1.0, 2);
  const std::vector<PlaceShare> predicted = model.predict(std::vector<PlaceShare>{{4, 0.7}});
  ASSERT_EQ(predicted.size(), 5U);  // places 2 to 6
  double sum = 0.0;
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    EXPECT_EQ(predicted[i].place, static_cast<int>(i) + 2);
    sum += predicted[i].probability;
  }
  EXPECT_NEAR(sum, 0.7, 1e-12);
  EXPECT_NEAR(predicted[1].probability / predicted[2].probability, std::exp(-0.5), 1e-9);
  EXPECT_NEAR(predicted[4].probability / predicted[2].probability, std::exp(-2.0), 1e-9);
  EXPECT_NEAR(predicted[1].probability, predicted[3].probability, 1e-12);
}

TEST(MotionModel, AddsUpWhatComesFromSeveralPlaces) {
  const map::PlaceGraph graph(corridor());
  const MotionModel model(graph, 1.0, 1);
  const auto both = model.predict(std::vector<PlaceShare>{{2, 0.25}, {3, 0.5}});
  const auto first = model.predict(std::vector<PlaceShare>{{2, 0.25}});
  const auto second = model.predict(std::vector<PlaceShare>{{3, 0.5}});
  ASSERT_EQ(both.size(), 4U);
  EXPECT_NEAR(both[1].probability, first[1].probability + second[0].probability, 1e-12);
}

TEST(Localiser, FollowsADriveAlongTheCorridor) {
  Localiser localiser(corridor(), {});
  for (int i = 0; i < kPlaces; ++i) {
    const Belief belief = localiser.update(seen_at(i, 0.15, 0.4 * i));
    EXPECT_EQ(belief.updates, i + 1);
    ASSERT_FALSE(belief.top.empty());
    EXPECT_LE(belief.top.size(), 5U);
    EXPECT_EQ(belief.top.front().place.str(), std::string(1, static_cast<char>('A' + i)));
    EXPECT_FALSE(belief.lost) << i;
    if (i > 0) {
      EXPECT_GT(belief.top.front().probability, 0.8) << i;
    }
    double sum = 0.0;
    double before = 1.0;
    for (const PlaceProbability& place : belief.top) {
      EXPECT_LE(place.probability, before);
      before = place.probability;
      sum += place.probability;
    }
    EXPECT_LE(sum, 1.0 + 1e-9);
  }
}

TEST(Localiser, TheWayThereTellsLookAlikesApart) {
  // C and H look the same: one picture cannot say which; having come from B does.
  const map::TopologicalMap map = corridor({2, 7});
  Localiser localiser(map, {});
  const Belief first = localiser.update(seen_at(2, 0.05, 0.0));
  ASSERT_GE(first.top.size(), 2U);
  EXPECT_NEAR(first.top[0].probability, first.top[1].probability, 0.01);
  localiser.restart();
  localiser.update(seen_at(1, 0.05, 0.0));
  const Belief second = localiser.update(seen_at(2, 0.05, 0.0));
  EXPECT_EQ(second.updates, 2);
  EXPECT_EQ(second.top.front().place.str(), "C");
  EXPECT_GT(second.top.front().probability, 0.9);
}

TEST(Localiser, FindsAKidnappedRobotAgain) {
  Localiser localiser(corridor(), {});
  for (int i = 0; i < 4; ++i) localiser.update(seen_at(1, 0.02 * i, 0.0));
  Belief belief;
  int updates = 0;
  do {
    belief = localiser.update(seen_at(8, 0.02 * updates, 1.0));
    ++updates;
  } while (updates < 6 && belief.top.front().place.str() != "I");
  EXPECT_LE(updates, 3);
  belief = localiser.update(seen_at(8, 0.1, 1.0));
  EXPECT_EQ(belief.top.front().place.str(), "I");
  EXPECT_GT(belief.top.front().probability, 0.8);
  EXPECT_FALSE(belief.lost);
}

TEST(Localiser, SaysLostInAForeignHouseAndComesBack) {
  Localiser localiser(corridor(), {});
  localiser.update(seen_at(3, 0.05, 0.0));
  Belief belief;
  for (int i = 0; i < 6; ++i) belief = localiser.update(seen_at(100 + i, 0.0, 0.0));
  EXPECT_TRUE(belief.lost);
  for (int i = 0; i < 3; ++i) belief = localiser.update(seen_at(3, 0.05, 0.0));
  EXPECT_FALSE(belief.lost);
  EXPECT_EQ(belief.top.front().place.str(), "D");
}

TEST(Localiser, ACoveredLensIsLostAndForgetsNothing) {
  Localiser localiser(corridor(), {});
  localiser.update(seen_at(3, 0.05, 0.0));
  const Belief before = localiser.update(seen_at(3, 0.05, 0.0));
  const Belief covered = localiser.update({});
  EXPECT_TRUE(covered.lost);
  EXPECT_EQ(covered.updates, 3);
  EXPECT_EQ(covered.top.front().place, before.top.front().place);
  EXPECT_LT(covered.top.front().probability, before.top.front().probability);  // it may have driven on
  EXPECT_FALSE(localiser.update(seen_at(3, 0.05, 0.0)).lost);
}

TEST(Localiser, RestartForgets) {
  Localiser localiser(corridor(), {});
  const Belief first = localiser.update(seen_at(5, 0.05, 0.0));
  localiser.update(seen_at(5, 0.05, 0.0));
  localiser.restart();
  const Belief again = localiser.update(seen_at(5, 0.05, 0.0));
  EXPECT_EQ(again.updates, 1);
  EXPECT_EQ(again.top.front().probability, first.top.front().probability);  // and is the same for the same pictures
}

TEST(Localiser, FindsThePlaceThatThePictureLooksLikeWithFewCandidates) {
  LocaliserConfig config;
  config.max_candidates = 2;
  Localiser localiser(corridor(), config);
  EXPECT_EQ(localiser.update(seen_at(6, 0.05, 0.0)).top.front().place.str(), "G");
  // One candidate where it is expected, one by its looks: it follows a drive and a kidnapping alike.
  EXPECT_EQ(localiser.update(seen_at(7, 0.05, 0.0)).top.front().place.str(), "H");
  localiser.update(seen_at(1, 0.05, 0.0));
  EXPECT_EQ(localiser.update(seen_at(1, 0.05, 0.0)).top.front().place.str(), "B");
}

TEST(Localiser, PlacesWithoutSiftFeaturesAreFoundByTheirColours) {
  map::TopologicalMap map = corridor();
  for (int i = 0; i < kPlaces; ++i) {
    features::Appearance& appearance = map.places[static_cast<std::size_t>(i)].appearances[0];
    appearance.columns = std::exchange(appearance.sift, {});
    appearance.colour_moments.fill(0.1F * static_cast<float>(i));
  }
  const CandidateFinder finder(map);
  features::Appearance seen = map.places[6].appearances[0];
  seen.colour_moments.fill(0.59F);
  EXPECT_EQ(finder.find(seen, 2, {}), (std::vector<int>{6, 5}));
  EXPECT_EQ(finder.find(seen, 2, {6}), (std::vector<int>{5, 7}));
}

TEST(CandidateFinder, NamesEachPlaceOnceAndNoneThatIsKnown) {
  map::TopologicalMap map = corridor();
  map.places[3].appearances = {seen_at(3, 0.0, 0.0), seen_at(3, 0.1, 1.0), seen_at(3, 0.2, 2.0)};
  const CandidateFinder finder(map);
  const std::vector<int> all = finder.find(seen_at(3, 0.05, 0.0), 4, {});
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all.front(), 3);
  EXPECT_EQ(std::set<int>(all.begin(), all.end()).size(), 4U);
  const std::vector<int> others = finder.find(seen_at(3, 0.05, 0.0), 4, {3});
  ASSERT_EQ(others.size(), 4U);
  EXPECT_EQ(std::ranges::count(others, 3), 0);
}

TEST(Localiser, AnotherOneStartsAnew) {
  Localiser localiser(corridor(), {});
  const Belief first = localiser.update(seen_at(5, 0.05, 0.0));
  Localiser second = localiser.another();
  const Belief again = second.update(seen_at(5, 0.05, 0.0));
  EXPECT_EQ(again.updates, 1);
  EXPECT_EQ(again.top.front().probability, first.top.front().probability);
}

TEST(Localiser, ReportsTheCalibratedProbabilityOfThePlaceAndItsNeighbours) {
  map::TopologicalMap map = corridor({4, 5});  // E and F look the same: each alone is half as probable
  map.calibration = {0.5, 0.7};
  Localiser localiser(map, {});
  const Belief belief = localiser.update(seen_at(4, 0.3, 0.0));
  ASSERT_GE(belief.top.size(), 2U);
  EXPECT_LT(belief.top[0].probability, 0.55);
  EXPECT_NEAR(belief.near_share, belief.top[0].probability + belief.top[1].probability, 1e-3);
  EXPECT_NEAR(belief.near_probability, calibrated(map.calibration, belief.near_share), 1e-12);
}

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
  const Belief belief = localiser.hear(PlaceId("H"), 0.95);
  EXPECT_EQ(best(belief), "H");
  EXPECT_GT(probability_of(belief, "H"), 0.8);
  EXPECT_LE(belief.near_share, 0.95 + 1e-9);
  Localiser unsure(map, {});
  const Belief before = unsure.update(seen_at(2, 0.05, 0.0), Pose2{});
  EXPECT_EQ(probability_of(unsure.hear(PlaceId("H"), 0.89), "H"), probability_of(before, "H"));
  EXPECT_EQ(probability_of(unsure.hear(PlaceId("nowhere"), 1.0), "H"), probability_of(before, "H"));
}

TEST(LocaliserWithOdometry, WhatItHearsDoesNotOutweighPicturesThatAreClear) {
  Localiser localiser(measured_corridor(), {});
  Belief belief;
  for (int k = 0; k < 6; ++k) {
    localiser.update(seen_at(3, 0.1 * k, 0.0), Pose2{0.5 * k, 0.0, 0.0});
    belief = localiser.hear(PlaceId("I"), 0.97);
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
      belief = localiser.hear(PlaceId("H"), 0.95);
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
  const Belief belief = localiser.hear(PlaceId("I"), 0.97);
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
  Localiser told(map, {});
  Localiser untold(map, {});
  for (Localiser* localiser : {&told, &untold}) localiser->update(seen_at(3, 0.05, 0.0), Pose2{4.0, 0.0, 0.0});
  told.restart_odometry();
  // The count begins at zero again: to one who was not told, that is a drive of four metres.
  const Belief next = told.update(seen_at(4, 0.05, 0.0), Pose2{});
  EXPECT_EQ(next.updates, 2);
  EXPECT_EQ(best(next), "E");
  EXPECT_GT(next.top.front().probability, 0.9);
  const Belief misled = untold.update(seen_at(4, 0.05, 0.0), Pose2{});
  EXPECT_EQ(best(misled), "H");
  EXPECT_GT(probability_of(next, "E"), probability_of(misled, "E"));
  // From here on the new count tells the way.
  EXPECT_EQ(best(told.update(seen_at(5, 0.05, 0.0), Pose2{1.0, 0.0, 0.0})), "F");
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

TEST(Localiser, AnEmptyMapIsLost) {
  Localiser localiser(map::TopologicalMap{}, {});
  const Belief belief = localiser.update(seen_at(1, 0.0, 0.0));
  EXPECT_TRUE(belief.lost);
  EXPECT_TRUE(belief.top.empty());
}

}  // namespace
}  // namespace homeward::localisation::localiser_test
