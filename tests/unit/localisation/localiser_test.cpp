// SPDX-License-Identifier: Apache-2.0
#include "localisation/localiser.hpp"

#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "localisation/calibration.hpp"
#include "localisation/candidates.hpp"
#include "localisation/motion_model.hpp"
#include "support/landmark_corridor.hpp"

namespace homeward::localisation::localiser_test {
namespace {

using homeward::testing::corridor;
using homeward::testing::seen_at;

constexpr int kPlaces = homeward::testing::kCorridorPlaces;

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

TEST(Localiser, AStatedStartTellsLookAlikesApart) {
  Localiser localiser(corridor({1, 7}), {});
  const Belief unsure = localiser.update(seen_at(1, 0.05, 0.0));
  EXPECT_LT(unsure.top.front().probability, 0.6);
  localiser.start_at({PlaceId("H")});
  const Belief belief = localiser.update(seen_at(1, 0.05, 0.0));
  EXPECT_EQ(belief.updates, 1);
  EXPECT_EQ(belief.top.front().place.str(), "H");
  EXPECT_GT(belief.top.front().probability, 0.9);
  // The place beside the one that was named does too.
  localiser.start_at({PlaceId("C")});
  EXPECT_EQ(localiser.update(seen_at(1, 0.05, 0.0)).top.front().place.str(), "B");
}

TEST(Localiser, SightingsOverruleAStatedStart) {
  Localiser localiser(corridor(), {});
  localiser.start_at({PlaceId("B")});
  Belief belief;
  for (int i = 0; i < 2; ++i) belief = localiser.update(seen_at(8, 0.02 * i, 1.0));
  EXPECT_EQ(belief.top.front().place.str(), "I");
  EXPECT_FALSE(belief.lost);
}

TEST(Localiser, AStartAtNoPlaceOfTheMapIsAnyStart) {
  Localiser localiser(corridor(), {});
  const Belief before = localiser.update(seen_at(5, 0.05, 0.0));
  localiser.start_at({PlaceId("nowhere")});
  const Belief after = localiser.update(seen_at(5, 0.05, 0.0));
  EXPECT_EQ(after.updates, 1);
  EXPECT_EQ(after.top.front().probability, before.top.front().probability);
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
    map::AppearanceList& known = map.places[static_cast<std::size_t>(i)].appearances;
    features::Appearance appearance = known[0];
    appearance.columns = std::exchange(appearance.sift, {});
    appearance.colour_moments.fill(0.1F * static_cast<float>(i));
    known = {appearance};
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

TEST(Localiser, AnEmptyMapIsLost) {
  Localiser localiser(map::TopologicalMap{}, {});
  const Belief belief = localiser.update(seen_at(1, 0.0, 0.0));
  EXPECT_TRUE(belief.lost);
  EXPECT_TRUE(belief.top.empty());
}

}  // namespace
}  // namespace homeward::localisation::localiser_test
