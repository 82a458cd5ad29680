// SPDX-License-Identifier: Apache-2.0
#include "mapping/closed_way.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/angles.hpp"
#include "mapping/closed_loops.hpp"
#include "support/posed_drive.hpp"
#include "support/single_images.hpp"

namespace homeward::mapping::closed_way_test {
namespace {

using homeward::testing::PosedDrive;
using homeward::testing::seen_between;
using homeward::testing::singles;

/// A corridor of `length` steps driven there and back `times` times; lengths of the pictures alone, odd lanes 0.3 steps
/// aside.
struct Corridor : PosedDrive {
  [[nodiscard]] TourTrack track(double picture_length_sigma) const {
    TrackConfig config;
    config.picture_length_sigma = picture_length_sigma;
    config.least_length_sigma = picture_length_sigma;  // as assumed: tests say how sure the way is
    return TourTrack(images, tour_of, pairs, false, 3.0, config);
  }
};

PairRelation seen(const Pose2& a, const Pose2& b) {
  PairRelation relation = seen_between(a, b);
  relation.distance = relation.parallax_rad;  // both grow with the way between them
  return relation;
}

/// What pictures up to 3 steps apart tell of each other.
void relate(Corridor& tour) {
  tour.pairs = PairTable(static_cast<int>(tour.truth.size()));
  for (std::size_t b = 0; b < tour.truth.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      const Pose2 between = inverse(tour.truth[a]) * tour.truth[b];
      if (std::hypot(between.x_m, between.y_m) > 3.0) continue;
      tour.pairs.set(static_cast<int>(a), static_cast<int>(b), seen(tour.truth[a], tour.truth[b]));
    }
  }
}

Corridor corridor(int length, int times) {
  Corridor result;
  Pose2 at{};
  result.add(at, std::nullopt);
  for (int pass = 0; pass < times; ++pass) {
    for (int i = 0; i < length; ++i) {
      at = at * Pose2{1.0, 0.0, 0.0};
      result.add(at, std::nullopt);
    }
    for (int i = 0; i < 4; ++i) {
      at = at * Pose2{0.0, 0.0, kPi / 4.0};
      result.add(at, std::nullopt);
    }
  }
  relate(result);
  return result;
}

double measured_length_sigma(const Corridor& tour) {
  return TourTrack(tour.images, tour.tour_of, tour.pairs, false, 3.0, {}).length_sigma();
}

TEST(LengthAccuracy, IsMeasuredOnShortLoops) {
  EXPECT_EQ(measured_length_sigma(corridor(60, 1)), TrackConfig().picture_length_sigma);  // no loop, nothing known
  const Corridor even = corridor(10, 6);
  EXPECT_LT(measured_length_sigma(even), 0.15);
  // Most of the pairs that look like one spot are 5 to 8 steps apart: they do not hide the loops.
  Corridor deceiving = even;
  int loops = 0;
  int alike = 0;
  for (int a = 0; a < deceiving.pairs.images(); ++a) {
    for (int b = a + 13; b < deceiving.pairs.images() && b <= a + 40; ++b) {
      const Pose2 between =
          inverse(deceiving.truth[static_cast<std::size_t>(a)]) * deceiving.truth[static_cast<std::size_t>(b)];
      const double apart = std::hypot(between.x_m, between.y_m);
      loops += apart <= 1.0 ? 1 : 0;
      if (apart < 5.0 || apart > 8.0) continue;
      ++alike;
      deceiving.pairs.set(a, b, seen({}, {0.1, 0.1, between.theta_rad}));
    }
  }
  EXPECT_GT(alike, loops);
  EXPECT_LT(measured_length_sigma(deceiving), 0.15);
}

TEST(LengthAccuracy, StepsThatDifferAreLessExact) {
  std::mt19937 random(3);  // three of ten pictures are missing
  const Corridor full = corridor(15, 8);
  Corridor uneven;
  for (std::size_t i = 0; i < full.truth.size(); ++i) {
    if (random() % 10 < 3) continue;
    uneven.truth.push_back(full.truth[i]);
    uneven.images.push_back(full.images[i]);
    uneven.tour_of.push_back(0);
  }
  relate(uneven);
  EXPECT_GT(measured_length_sigma(uneven), measured_length_sigma(full) + 0.05);
}

LoopTie tie(const Corridor& tour, int a, int b, int group) {
  const Pose2 between = inverse(tour.truth[static_cast<std::size_t>(a)]) * tour.truth[static_cast<std::size_t>(b)];
  return {a, b, between.x_m, between.y_m, 1.0, between.theta_rad, group};
}

TEST(ClosedWay, WithoutLoopsIsTheWayDriven) {
  const Corridor tour = corridor(10, 3);
  const TourTrack track = tour.track(0.35);
  const ClosedWay way(track, {});
  for (const auto& [a, b] : {std::pair(0, 9), std::pair(3, 30), std::pair(12, 13)}) {
    const TrackPrediction open = track.predict(a, b);
    const TrackPrediction closed = way.predict(a, b);
    EXPECT_TRUE(closed.known);
    EXPECT_NEAR(closed.distance, open.distance, 1e-3);
    EXPECT_NEAR(closed.distance_sigma, open.distance_sigma, 0.02);
    EXPECT_NEAR(wrap_angle(closed.turn_rad - open.turn_rad), 0.0, 1e-4);
    EXPECT_NEAR(closed.turn_sigma_rad, open.turn_sigma_rad, 1e-5);
  }
}

TEST(ClosedWay, LoopsMakeWhatLiesBetweenThemMoreCertain) {
  const Corridor tour = corridor(20, 4);
  const TourTrack track = tour.track(0.35);
  const int last = static_cast<int>(tour.truth.size()) - 1;
  const ClosedWay way(track, {tie(tour, 0, 47, 0), tie(tour, 47, last, 1)});
  EXPECT_LT(way.predict(5, last - 8).distance_sigma, 0.7 * track.predict(5, last - 8).distance_sigma);
  EXPECT_NEAR(way.predict(5, last - 8).distance, track.predict(5, last - 8).distance, 0.1);  // the truth already
}

/// What the way and the loops of all other groups say about each tie, in the order of the ties.
std::vector<ClosedWay::Without> without_own_group(const ClosedWay& way, const std::vector<LoopTie>& ties) {
  std::vector<ClosedWay::Without> result;
  for (std::size_t begin = 0; begin < ties.size();) {
    std::vector<std::size_t> group;
    for (std::size_t t = begin; t < ties.size() && ties[t].group == ties[begin].group; ++t) group.push_back(t);
    begin += group.size();
    const std::vector<ClosedWay::Without> of_group = way.without(group);
    result.insert(result.end(), of_group.begin(), of_group.end());
  }
  return result;
}

TEST(ClosedWay, ATieIsJudgedByTheOthersAlone) {
  const Corridor tour = corridor(15, 4);
  const TourTrack track = tour.track(0.35);
  // The third one is wrong by 6 steps.
  std::vector<LoopTie> ties = {tie(tour, 2, 38, 0), tie(tour, 3, 39, 0), tie(tour, 10, 66, 1), tie(tour, 25, 50, 2)};
  ties[2].x += 6.0;
  const std::vector<ClosedWay::Without> all = without_own_group(ClosedWay(track, ties), ties);
  for (std::size_t t = 0; t < ties.size(); ++t) {
    std::vector<LoopTie> others;
    for (const LoopTie& other : ties) {
      if (other.group != ties[t].group) others.push_back(other);
    }
    const TrackPrediction expected = ClosedWay(track, others).predict(ties[t].a, ties[t].b);
    EXPECT_TRUE(all[t].prediction.known);
    EXPECT_NEAR(all[t].prediction.distance, expected.distance, 0.02) << t;
    EXPECT_NEAR(all[t].prediction.distance_sigma, expected.distance_sigma, 0.05) << t;
  }
  EXPECT_GT(all[2].miss_sigmas, 2.0 * all[0].miss_sigmas);
  EXPECT_GT(all[2].miss_sigmas, 2.0 * all[3].miss_sigmas);
}

TEST(ClosedWay, ABrokenWayTellsNothing) {
  Corridor tour = corridor(10, 2);
  tour.pairs.set(14, 15, {});  // these two have nothing in common
  const TourTrack track = tour.track(0.35);
  const std::vector<LoopTie> ties = {tie(tour, 2, 20, 0), tie(tour, 1, 5, 1)};
  const ClosedWay way(track, ties);
  EXPECT_FALSE(way.predict(2, 20).known);
  EXPECT_TRUE(way.predict(1, 9).known);
  EXPECT_FALSE(without_own_group(way, ties)[0].prediction.known);
  EXPECT_TRUE(without_own_group(way, ties)[1].prediction.known);
}

constexpr int kLength = 30;

/// The image of a pass that is `along` steps from the beginning of the corridor.
int image_at(int pass, int along) { return pass * (kLength + 4) + (pass % 2 == 0 ? along : kLength - along); }

/// Loops between four passes of a corridor, the last of them a run of false ones: stretches that look alike, `wrong_by`
/// steps apart. What the way is taken to be known by is so little that it does not exclude them by itself.
struct Loops {
  Corridor tour = corridor(kLength, 4);
  std::vector<Subcluster> parts;
  std::vector<LoopHypothesis> hypotheses;
  std::vector<std::size_t> false_ones;

  explicit Loops(int wrong_by) {
    std::vector<int> images;
    for (int i = 0; i < static_cast<int>(tour.truth.size()); ++i) images.push_back(i);
    parts = singles(images);
    for (int along = 2; along < kLength; along += 4) {
      accept(image_at(0, along), image_at(1, along));
      accept(image_at(0, along), image_at(2, along));
      accept(image_at(1, along), image_at(2, along));
    }
    for (int along = 18; along < kLength; along += 4) accept(image_at(0, along), image_at(3, along));
    for (int along = 2; along < 14; along += 4) {
      const int a = image_at(2, along);
      const int b = image_at(3, along + wrong_by);
      PairRelation alike = seen({}, {0.2, 0.1, 0.0});
      alike.turn_rad = static_cast<float>(kPi);
      tour.pairs.set(a, b, alike);
      false_ones.push_back(hypotheses.size());
      accept(a, b);
    }
  }

  void accept(int a, int b) {
    LoopHypothesis hypothesis;
    hypothesis.a = a;
    hypothesis.b = b;
    hypothesis.similarity = 0.9;
    hypothesis.after = {0.95, 0.01, 0.04};
    hypothesis.decision = map::Decision::kAccepted;
    hypotheses.push_back(hypothesis);
  }
};

TEST(TakeBack, ARunThatTheOthersExcludeGoesAndNoOther) {
  const Loops loops(8);
  const TourTrack track = loops.tour.track(0.35);
  for (const std::size_t h : loops.false_ones) {
    EXPECT_NE(track.judge(loops.hypotheses[h].a, loops.hypotheses[h].b).verdict, TrackVerdict::kContradicts);
  }
  EXPECT_EQ(take_back(loops.hypotheses, loops.parts, loops.tour.pairs, track, {}), loops.false_ones);
}

TEST(TakeBack, WhatFitsStays) {
  const Loops loops(0);
  EXPECT_TRUE(take_back(loops.hypotheses, loops.parts, loops.tour.pairs, loops.tour.track(0.35), {}).empty());
}

TEST(TakeBack, NotWhatAPersonDecided) {
  Loops loops(8);
  for (const std::size_t h : loops.false_ones) loops.hypotheses[h].by = map::Decider::kPerson;
  for (const std::size_t h : take_back(loops.hypotheses, loops.parts, loops.tour.pairs, loops.tour.track(0.35), {})) {
    EXPECT_EQ(loops.hypotheses[h].by, map::Decider::kMethod);
  }
}

TEST(CloseWay, RunsAreGroups) {
  const Loops loops(8);
  const WayWithLoops closed = close_way(loops.hypotheses, loops.parts, loops.tour.pairs, loops.tour.track(0.35), {});
  ASSERT_EQ(closed.ties.size(), loops.hypotheses.size());
  const int false_group = closed.ties[static_cast<std::size_t>(closed.tie_of[loops.false_ones.front()])].group;
  for (std::size_t h = 0; h < loops.hypotheses.size(); ++h) {
    const auto tie = static_cast<std::size_t>(closed.tie_of[h]);
    EXPECT_EQ(closed.hypothesis_of[tie], h);
    const bool is_false = std::ranges::find(loops.false_ones, h) != loops.false_ones.end();
    EXPECT_EQ(closed.ties[tie].group == false_group, is_false) << h;
  }
}

}  // namespace
}  // namespace homeward::mapping::closed_way_test
