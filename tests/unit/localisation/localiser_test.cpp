// SPDX-License-Identifier: Apache-2.0
#include "localisation/localiser.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "localisation/motion_model.hpp"
#include "support/ascii_map.hpp"
#include "support/planar_scene.hpp"
#include "support/sample_map.hpp"

namespace homeward::localisation {
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
  std::vector<double> belief(kPlaces, 0.0);
  belief[4] = 0.7;
  const std::vector<double> predicted = model.predict(belief);
  EXPECT_NEAR(std::accumulate(predicted.begin(), predicted.end(), 0.0), 0.7, 1e-12);
  EXPECT_EQ(predicted[1], 0.0);
  EXPECT_GT(predicted[2], 0.0);
  EXPECT_NEAR(predicted[3] / predicted[4], std::exp(-0.5), 1e-9);
  EXPECT_NEAR(predicted[6] / predicted[4], std::exp(-2.0), 1e-9);
  EXPECT_NEAR(predicted[3], predicted[5], 1e-12);
  EXPECT_EQ(predicted[7], 0.0);
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

TEST(Localiser, ComparesNoMoreCandidatesThanAllowed) {
  // One candidate alone: where it is expected or by colour. The belief still sums up and finds the place by its
  // colours.
  map::TopologicalMap map = corridor();
  for (int i = 0; i < kPlaces; ++i) {
    map.places[static_cast<std::size_t>(i)].appearances[0].colour_moments.fill(0.1F * static_cast<float>(i));
  }
  LocaliserConfig config;
  config.max_candidates = 2;
  Localiser localiser(map, config);
  features::Appearance seen = seen_at(6, 0.05, 0.0);
  seen.colour_moments.fill(0.59F);
  EXPECT_EQ(localiser.update(seen).top.front().place.str(), "G");
}

TEST(Localiser, AnEmptyMapIsLost) {
  Localiser localiser(map::TopologicalMap{}, {});
  const Belief belief = localiser.update(seen_at(1, 0.0, 0.0));
  EXPECT_TRUE(belief.lost);
  EXPECT_TRUE(belief.top.empty());
}

}  // namespace
}  // namespace homeward::localisation
