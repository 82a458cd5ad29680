// SPDX-License-Identifier: Apache-2.0
#include "mapping/loops.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/angles.hpp"
#include "mapping/grow.hpp"
#include "support/corridor_tour.hpp"

namespace homeward::mapping::loops_test {
namespace {

using homeward::testing::corridor_tour;
using homeward::testing::CorridorTour;
using homeward::testing::walk;

TEST(SamePlaceScale, WeighsAgainstThePlaceBeside) {
  const SamePlaceScale scale({0.1F, 0.2F, 0.3F, 0.4F}, {0.35F, 0.6F, 0.8F, 1.0F});
  EXPECT_DOUBLE_EQ(scale.similarity(0.0F), 1.0);
  EXPECT_DOUBLE_EQ(scale.similarity(0.3F), 1.0);  // three of four of one place are more alike, but none beside
  EXPECT_DOUBLE_EQ(scale.similarity(0.38F), 0.5);
  EXPECT_DOUBLE_EQ(scale.similarity(0.7F), 0.0);
  EXPECT_DOUBLE_EQ(scale.similarity(std::numeric_limits<float>::infinity()), 0.0);
  const SamePlaceScale alone({0.1F, 0.2F, 0.3F, 0.4F}, {});
  EXPECT_DOUBLE_EQ(alone.similarity(0.3F), 0.5);
  EXPECT_DOUBLE_EQ(SamePlaceScale({}, {}).similarity(0.3F), 0.0);
}

/// How many of the first `there` images share a place with the one of the way back.
int joined(const map::TopologicalMap& map, const CorridorTour& tour, int there) {
  int found = 0;
  for (int i = 0; i < there; ++i) {
    const ImageId& one = tour.images[static_cast<std::size_t>(i)].id;
    const ImageId& other = tour.images[static_cast<std::size_t>(2 * there - 1 - i)].id;
    for (const map::Place& place : map.places) {
      found += std::ranges::find(place.members, one) != place.members.end() &&
                       std::ranges::find(place.members, other) != place.members.end()
                   ? 1
                   : 0;
    }
  }
  return found;
}

/// There and back along a corridor; on the way back everything looks a little different, so that complete linkage parts
/// the two: images of one pass are always more alike.
CorridorTour other_light(float more) {
  CorridorTour tour = corridor_tour(walk(30, true), {60});
  for (int a = 0; a < 30; ++a) {
    for (int b = 30; b < 60; ++b) {
      PairRelation relation = tour.pairs.relation(a, b);
      if (!relation.verified()) continue;
      relation.distance += more;
      tour.pairs.set(a, b, relation);
    }
  }
  return tour;
}

TEST(CloseLoops, JoinsAcrossClustersWhatLinkageParted) {
  const CorridorTour tour = other_light(0.35F);
  MappingConfig config;
  const map::TopologicalMap with = make_map(tour.input(), config, nullptr);
  config.sources.across = false;
  const map::TopologicalMap without = make_map(tour.input(), config, nullptr);
  EXPECT_GT(joined(with, tour, 30), joined(without, tour, 30) + 5);
  // No place swallows its neighbour on the way.
  for (const map::Place& place : with.places) EXPECT_LE(place.members.size(), 10U);
}

/// There and back along a corridor, of whose features no two pictures of the two ways share more than this.
CorridorTour hardly_met(float share) {
  CorridorTour tour = corridor_tour(walk(30, true), {60});
  for (int a = 0; a < 30; ++a) {
    for (int b = 30; b < 60; ++b) {
      PairRelation relation = tour.pairs.relation(a, b);
      if (!relation.verified()) continue;
      relation.match_share = std::min(relation.match_share, share);
      tour.pairs.set(a, b, relation);
    }
  }
  return tour;
}

TEST(CloseLoops, LeavesOpenWhatSharesTooLittleToBeOneSpot) {
  MappingConfig config;
  const map::TopologicalMap met = make_map(hardly_met(1.0F).input(), config, nullptr);
  const CorridorTour tour = hardly_met(0.9F * config.least_meeting_share);
  const map::TopologicalMap open = make_map(tour.input(), config, nullptr);
  EXPECT_GT(joined(met, hardly_met(1.0F), 30), 20);
  EXPECT_LE(joined(open, tour, 30), 4);  // where it turns round they follow each other
  ASSERT_GT(open.hypotheses.size(), 5U);
  for (const map::Hypothesis& hypothesis : open.hypotheses) {
    EXPECT_NE(hypothesis.decision, map::Decision::kAccepted);
  }
  // A person may know better.
  map::TopologicalMap decided = open;
  map::Edit edit;
  edit.kind = map::EditKind::kDecide;
  edit.image_a = open.hypotheses.front().prototype_a;
  edit.image_b = open.hypotheses.front().prototype_b;
  edit.text = "accept";
  decided.edits.push_back(edit);
  EXPECT_GT(joined(make_map(tour.input(), config, &decided), tour, 30), joined(open, tour, 30));
}

TEST(CloseLoops, StopsFarApartArePlacesOfTheirOwn) {
  CorridorTour tour = corridor_tour(walk(30, false), {30});
  for (int b = 1; b < 30; ++b) {
    for (int a = 0; a < b; ++a) {
      PairRelation relation = tour.pairs.relation(a, b);
      if (!relation.verified()) continue;
      relation.match_share = 0.9F * MappingConfig().least_place_share;
      tour.pairs.set(a, b, relation);
    }
  }
  EXPECT_EQ(make_map(tour.input(), {}, nullptr).places.size(), 30U);
}

constexpr int kLength = 30;

/// Four times along a corridor, turning at its ends, in steps of which pictures tell no more than that they are steps.
/// On the last pass the stretch from 10 to 22 looks like that from 2 to 14: a poster was moved.
CorridorTour moved_poster() {
  CorridorTour tour;
  std::vector<Pose2> truth{{}};
  const auto go = [&](const Pose2& step) { truth.push_back(truth.back() * step); };
  for (int pass = 0; pass < 4; ++pass) {
    for (int i = 0; i < kLength; ++i) go({1.0, 0.0, 0.0});
    for (int i = 0; i < 4; ++i) go({0.0, 0.0, kPi / 4.0});
  }
  const int count = static_cast<int>(truth.size());
  const int last_pass = 3 * (kLength + 4);
  tour.pairs = PairTable(count);
  for (int b = 0; b < count; ++b) {
    const auto index = static_cast<std::size_t>(b);
    tour.images.push_back({ImageId("t/" + std::to_string(1000 + b)), std::nullopt, std::nullopt});
    tour.tour_of.push_back(0);
    tour.appearances.push_back(homeward::testing::random_appearance(3, static_cast<unsigned>(b)));
    tour.position_m.push_back(truth[index].x_m);
    for (int a = 0; a < b; ++a) {
      Pose2 to = truth[index];
      if (a < last_pass && b >= last_pass && to.x_m > 9.5 && to.x_m < 22.5) to.x_m -= 8.0;
      const Pose2 between = inverse(truth[static_cast<std::size_t>(a)]) * to;
      const double apart = std::hypot(between.x_m, between.y_m);
      if (apart > 6.0) continue;
      PairRelation relation;
      relation.distance = static_cast<float>(0.2 * apart + 0.005 + 0.0005 * ((7 * a + 3 * b) % 11));
      relation.inliers = 60;
      relation.match_share = static_cast<float>(0.44 * std::exp(-0.55 * apart));
      relation.confidence = 0.95F;
      relation.direction_rad = static_cast<float>(std::atan2(between.y_m, between.x_m));
      relation.turn_rad = static_cast<float>(between.theta_rad);
      relation.parallax_rad = static_cast<float>(0.2 * apart);
      tour.pairs.set(a, b, relation);
    }
  }
  return tour;
}

double width(const CorridorTour& tour, const map::Place& place) {
  double least = 1e9;
  double most = -1e9;
  for (const ImageId& member : place.members) {
    const double along = tour.position_m[static_cast<std::size_t>(std::stoi(member.str().substr(2)) - 1000)];
    least = std::min(least, along);
    most = std::max(most, along);
  }
  return most - least;
}

TEST(CloseLoops, WhatLaterLoopsExcludeIsTakenBackAndSaysSo) {
  const CorridorTour tour = moved_poster();
  MappingConfig config;
  config.track.least_length_sigma = config.track.picture_length_sigma;
  config.sources.take_back = false;
  config.sources.closed_way = false;
  const auto widest = [&](const map::TopologicalMap& map) {
    double result = 0.0;
    for (const map::Place& place : map.places) result = std::max(result, width(tour, place));
    return result;
  };
  EXPECT_GT(widest(make_map(tour.input(), config, nullptr)), 6.0);  // the way alone does not exclude it
  config.sources.take_back = true;
  const NotedMap made = make_noted_map(tour.input(), config, nullptr);
  EXPECT_LT(widest(made.map), 5.0);
  int taken_back = 0;
  int accepted = 0;
  for (std::size_t h = 0; h < made.map.hypotheses.size(); ++h) {
    const map::Hypothesis& hypothesis = made.map.hypotheses[h];
    accepted += hypothesis.decision == map::Decision::kAccepted ? 1 : 0;
    if (made.notes.taken_back[h] == 0) continue;
    ++taken_back;
    EXPECT_EQ(hypothesis.decision, map::Decision::kRejected);
    EXPECT_EQ(hypothesis.by, map::Decider::kMethod);
    EXPECT_GT(hypothesis.masses_before.is_true, 0.4);  // why it was believed
    EXPECT_GT(hypothesis.masses_after.is_false, 0.9);
    EXPECT_LT(hypothesis.plausibility, 0.1);
  }
  EXPECT_GT(taken_back, 2);
  EXPECT_GT(accepted, 10);
}

TEST(CloseLoops, GrowingTakesBackWhatTheNewToursLoopsExclude) {
  const CorridorTour elsewhere = corridor_tour(walk(12, false), {12});
  const map::TopologicalMap old = make_map(elsewhere.input(), {}, nullptr);
  CorridorTour tour = moved_poster();
  const GrowthInput input = growth_input(old, {tour.images, tour.tour_of, tour.appearances, {}}).value();
  PairTable pairs(static_cast<int>(input.images.size()));
  for (int b = 0; b < input.new_images; ++b) {
    for (const int a : tour.pairs.partners(b)) {
      if (a < b) pairs.set(a, b, tour.pairs.relation(a, b));
    }
  }
  MappingConfig config;
  config.track.least_length_sigma = config.track.picture_length_sigma;
  const GrownMap grown = grow_map(old, input, pairs, config);
  int taken_back = 0;
  for (const map::Hypothesis& hypothesis : grown.map.hypotheses) {
    taken_back += hypothesis.masses_before.is_true > 0.4 && hypothesis.masses_after.is_false > 0.9 ? 1 : 0;
  }
  EXPECT_GT(taken_back, 2);
  for (std::size_t p = old.places.size(); p < grown.map.places.size(); ++p) {
    EXPECT_LT(width(tour, grown.map.places[p]), 5.0);
  }
}

}  // namespace
}  // namespace homeward::mapping::loops_test
