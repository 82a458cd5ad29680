// SPDX-License-Identifier: Apache-2.0
#include "localisation/place_belief.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/ascii_map.hpp"

namespace homeward::localisation::place_belief_test {
namespace {

constexpr double kFloor = 1e-4;
constexpr double kElsewhere = 1e-3;

map::TopologicalMap ring(int places) {
  map::TopologicalMap map;
  for (int i = 0; i < places; ++i) {
    map::Place place;
    place.id = PlaceId("p" + std::to_string(i));
    map.places.push_back(place);
  }
  for (int i = 0; i < places; ++i) {
    const int next = (i + 1) % places;
    for (const auto& [from, to] : {std::pair(i, next), std::pair(next, i)}) {
      map::Edge edge;
      edge.from = map.places[static_cast<std::size_t>(from)].id;
      edge.to = map.places[static_cast<std::size_t>(to)].id;
      map.edges.push_back(edge);
    }
  }
  return map;
}

double sum_of(const PlaceBelief& belief, int places) {
  double sum = belief.elsewhere();
  for (int place = 0; place < places; ++place) sum += belief.of(place);
  return sum;
}

/// The same filter with one number for every place.
struct Dense {
  std::vector<double> of;
  double elsewhere = 0.0;

  explicit Dense(int places)
      : of(static_cast<std::size_t>(places), 1.0 / (places + 1)), elsewhere(1.0 / (places + 1)) {}

  void predict(const MotionModel& motion, const MoveOdds& odds) {
    std::vector<PlaceShare> shares;
    double inside = 0.0;
    for (std::size_t i = 0; i < of.size(); ++i) {
      shares.push_back({static_cast<int>(i), of[i]});
      inside += of[i];
    }
    const double evenly =
        (odds.jump_probability * inside + odds.leave_probability * elsewhere) / static_cast<double>(of.size());
    for (const PlaceShare& share : motion.predict(shares)) {
      of[static_cast<std::size_t>(share.place)] =
          share.probability * (1.0 - odds.jump_probability - odds.leave_probability) + evenly;
    }
    elsewhere = elsewhere * (1.0 - odds.leave_probability) + inside * odds.leave_probability;
  }

  void weigh(const std::vector<PlaceShare>& seen) {
    std::vector<double> likelihoods(of.size(), kFloor);
    for (const PlaceShare& share : seen) {
      likelihoods[static_cast<std::size_t>(share.place)] = std::max(kFloor, share.probability);
    }
    double sum = elsewhere *= kElsewhere;
    for (std::size_t i = 0; i < of.size(); ++i) sum += of[i] *= likelihoods[i];
    for (double& probability : of) probability /= sum;
    elsewhere /= sum;
  }
};

TEST(PlaceBelief, IsTheFilterWithANumberForEveryPlace) {
  // On a ring every place gives and takes alike, so that the shared number is exact.
  constexpr int kPlaces = 60;
  const MotionModel motion(map::PlaceGraph(ring(kPlaces)), 1.0, 3);
  const MoveOdds odds;
  PlaceBelief belief(motion, odds);
  Dense dense(kPlaces);
  std::mt19937 random(7);
  std::uniform_int_distribution<int> any(0, kPlaces - 1);
  std::uniform_real_distribution<double> likelihood(0.0, 1.0);
  for (int update = 0; update < 40; ++update) {
    if (update > 0) {
      belief.predict();
      dense.predict(motion, odds);
    }
    const int first = any(random);
    std::vector<PlaceShare> seen;
    for (int i = 0; i < 5; ++i) seen.push_back({(first + 7 * i) % kPlaces, likelihood(random)});
    seen.push_back({(first + 3) % kPlaces, 0.0});  // below the floor
    belief.weigh(seen, kFloor, kElsewhere);
    dense.weigh(seen);
    ASSERT_NEAR(belief.elsewhere(), dense.elsewhere, 1e-6) << update;
    for (int place = 0; place < kPlaces; ++place) {
      ASSERT_NEAR(belief.of(place), dense.of[static_cast<std::size_t>(place)], 1e-6) << update << " " << place;
    }
    ASSERT_NEAR(sum_of(belief, kPlaces), 1.0, 1e-9);
  }
}

TEST(PlaceBelief, LosesNothingOnADrive) {
  constexpr int kPlaces = 30;
  const map::TopologicalMap map = ring(kPlaces);
  const map::PlaceGraph graph(map);
  const MotionModel motion(graph, 1.0, 3);
  const MetricMotion driven(map, graph);
  PlaceBelief belief(motion, {});
  belief.weigh(std::vector<PlaceShare>{{4, 0.9}, {17, 0.4}}, kFloor, kElsewhere);
  for (const double driven_m : {0.0, 0.3, 1.0, 5.0, 19.0}) {
    belief.predict(driven, driven_m);
    EXPECT_NEAR(sum_of(belief, kPlaces), 1.0, 1e-9) << driven_m;
  }
}

TEST(PlaceBelief, KeepsFewPlacesOfALargeMap) {
  constexpr int kPlaces = 5000;
  const MotionModel motion(map::PlaceGraph(ring(kPlaces)), 1.5, 4);
  PlaceBelief belief(motion, {});
  std::mt19937 random(3);
  std::uniform_int_distribution<int> any(0, kPlaces - 1);
  for (int update = 0; update < 200; ++update) {
    if (update > 0) belief.predict();
    std::vector<PlaceShare> seen;
    const int first = any(random);
    for (int i = 0; i < 16; ++i) seen.push_back({(first + 301 * i) % kPlaces, 0.5});
    belief.weigh(seen, kFloor, kElsewhere);
    ASSERT_LE(belief.kept(), 512U);
    ASSERT_NEAR(sum_of(belief, kPlaces), 1.0, 1e-9);
  }
}

TEST(PlaceBelief, NamesTheMostProbablePlacesFirst) {
  const MotionModel motion(map::PlaceGraph(ring(8)), 1.0, 1);
  PlaceBelief belief(motion, {});
  EXPECT_TRUE(belief.largest(3, true).empty());
  std::vector<PlaceShare> top = belief.largest(3);
  ASSERT_EQ(top.size(), 3U);
  EXPECT_EQ(top[0].place, 0);
  EXPECT_EQ(top[2].place, 2);
  belief.weigh(std::vector<PlaceShare>{{5, 0.2}, {2, 0.9}}, kFloor, kElsewhere);
  top = belief.largest(3);
  EXPECT_EQ(top[0].place, 2);
  EXPECT_EQ(top[1].place, 5);
  EXPECT_EQ(top[2].place, 0);
  EXPECT_NEAR(top[0].probability / top[1].probability, 4.5, 1e-6);
  EXPECT_EQ(belief.largest(5, true).size(), 2U);
  EXPECT_EQ(belief.largest(100).size(), 8U);
  belief.restart();
  EXPECT_NEAR(belief.of(2), 1.0 / 9.0, 1e-12);
}

TEST(PlaceBelief, AStatedStartSharesMostOfItAndLeavesTheRestToEverything) {
  const MotionModel motion(map::PlaceGraph(ring(8)), 1.0, 1);
  PlaceBelief belief(motion, {});
  belief.weigh(std::vector<PlaceShare>{{2, 0.9}}, kFloor, kElsewhere);
  belief.start_at(std::vector<int>{5, 4, 6}, 0.9);
  for (const int place : {4, 5, 6}) EXPECT_NEAR(belief.of(place), 0.3 + 0.1 / 9.0, 1e-12);
  for (const int place : {0, 2, 7}) EXPECT_NEAR(belief.of(place), 0.1 / 9.0, 1e-12);
  EXPECT_NEAR(belief.elsewhere(), 0.1 / 9.0, 1e-12);
  EXPECT_NEAR(sum_of(belief, 8), 1.0, 1e-12);
  belief.weigh(std::vector<PlaceShare>{{1, 1.0}}, kFloor, kElsewhere);
  EXPECT_GT(belief.of(1), 0.8) << "a clear sighting overrules it";
  belief.start_at({}, 0.9);
  EXPECT_NEAR(belief.of(5), 1.0 / 9.0, 1e-12);
}

TEST(PlaceBelief, HalfThePowerIsHalfTheNews) {
  const map::TopologicalMap map = ring(8);
  const map::PlaceGraph graph(map);
  const MotionModel motion(graph, 1.0, 3);
  PlaceBelief once(motion, {});
  PlaceBelief twice(motion, {});
  const std::vector<PlaceShare> seen = {{2, 0.9}, {5, 0.1}};
  once.weigh(seen, kFloor, kElsewhere);
  for (int k = 0; k < 2; ++k) twice.weigh(seen, kFloor, kElsewhere, 0.5);
  for (int place = 0; place < 8; ++place) EXPECT_NEAR(twice.of(place), once.of(place), 1e-9) << place;
  EXPECT_NEAR(twice.elsewhere(), once.elsewhere(), 1e-9);
}

TEST(PlaceBelief, WhatIsHeardMultipliesTheOddsOfPlacesUpToWhatItMayMakeThem) {
  const map::TopologicalMap map = ring(8);
  const map::PlaceGraph graph(map);
  const MotionModel motion(graph, 1.0, 3);
  PlaceBelief belief(motion, {});
  belief.weigh(std::vector<PlaceShare>{{2, 0.9}, {5, 0.1}}, kFloor, kElsewhere);
  const auto odds = [&] { return (belief.of(5) + belief.of(6)) / (1.0 - belief.of(5) - belief.of(6)); };
  const double before = odds();
  const double of_others = belief.of(2) / belief.elsewhere();
  const std::vector<int> there = {6, 5};  // 6 is as improbable as all that were not seen
  belief.apply_odds(there, 4.0, 0.97);
  EXPECT_NEAR(odds(), 4.0 * before, 1e-9);
  EXPECT_NEAR(sum_of(belief, 8), 1.0, 1e-12);
  EXPECT_NEAR(belief.of(2) / belief.elsewhere(), of_others, 1e-9) << "of the others it says nothing";
  belief.apply_odds(there, 1e9, 0.8);
  EXPECT_NEAR(belief.of(5) + belief.of(6), 0.8, 1e-9);
  belief.apply_odds(there, 4.0, 0.5);
  EXPECT_NEAR(belief.of(5) + belief.of(6), 0.8, 1e-9) << "it makes nothing less probable";
  belief.apply_odds({}, 4.0, 0.9);
  EXPECT_NEAR(sum_of(belief, 8), 1.0, 1e-12);
}

TEST(PlaceBelief, ARobotThatDroveHasHardlyJumped) {
  map::TopologicalMap map = ring(40);
  for (map::Edge& edge : map.edges) {
    edge.length_m = 1.0;
    edge.length_from = map::LengthSource::kOdometry;
  }
  const map::PlaceGraph graph(map);
  const MotionModel motion(graph, 1.0, 3);
  const MetricMotion driven(map, graph);
  const auto far_after = [&](double driven_m, double rolled_jump_probability) {
    PlaceBelief belief(motion, {0.01, rolled_jump_probability, 0.0});
    belief.weigh(std::vector<PlaceShare>{{10, 1.0}}, 1e-12, 1e-12);
    belief.predict(driven, driven_m);
    return belief.of(30);
  };
  EXPECT_DOUBLE_EQ(far_after(0.0, 0.01), far_after(0.0, 1e-4)) << "one that stands may have been carried";
  EXPECT_NEAR(far_after(1.0, 0.01) - far_after(1.0, 1e-4), 0.0099 / 40.0, 0.001 / 40.0);
}

TEST(PlaceBelief, AMapWithoutPlacesIsElsewhere) {
  const MotionModel motion(map::PlaceGraph(map::TopologicalMap{}), 1.0, 1);
  PlaceBelief belief(motion, {});
  belief.predict();
  belief.weigh({}, kFloor, kElsewhere);
  EXPECT_NEAR(belief.elsewhere(), 1.0, 1e-12);
  EXPECT_TRUE(belief.largest(5).empty());
}

}  // namespace
}  // namespace homeward::localisation::place_belief_test
