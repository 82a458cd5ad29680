// SPDX-License-Identifier: Apache-2.0
#include "repeat/node_scale.hpp"

#include <gtest/gtest.h>

#include <random>

namespace homeward::repeat::node_scale_test {
namespace {

struct TwoArcs {
  Arc before;
  Arc after;
};

/// Arcs of 0.5 m and `after_m` with points from 1 to 5 m, of which the first `common` are in both.
TwoArcs arcs_with(int common, double after_m, double noise, std::uint64_t seed = 1) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> away_m(1.0, 5.0);
  std::normal_distribution<double> off(0.0, 1.0);
  constexpr double kBefore_m = 0.5;
  TwoArcs arcs;
  arcs.before.has_baseline = true;
  arcs.after.has_baseline = true;
  for (int i = 0; i < 30; ++i) {
    const double distance_m = away_m(random);
    ArcMatch match;
    match.feature = i;
    match.distance_spread = noise + 0.01;
    match.to_nearness = kBefore_m / distance_m * std::exp(noise * off(random));
    arcs.before.matches.push_back(match);
    match.feature = i < common ? i : 100 + i;
    match.from_nearness = after_m / distance_m * std::exp(noise * off(random));
    arcs.after.matches.push_back(match);
  }
  return arcs;
}

TEST(NodeScale, IsTheRatioOfTheArcsLengths) {
  for (const double after_m : {0.1, 0.5, 2.0}) {
    const TwoArcs arcs = arcs_with(20, after_m, 0.0);
    const auto scale = node_scale(arcs.before, arcs.after, 5);
    ASSERT_TRUE(scale);
    EXPECT_NEAR(scale->ratio, after_m / 0.5, 1e-9);
    EXPECT_EQ(scale->common, 20);
    EXPECT_NEAR(scale->spread, 0.0, 1e-9);
    EXPECT_EQ(common_features(arcs.before, arcs.after), 20);
  }
}

TEST(NodeScale, BearsNoiseAndSomeWrongPoints) {
  TwoArcs arcs = arcs_with(30, 0.4, 0.05);
  for (std::size_t i = 0; i < 8; ++i) arcs.after.matches[i].from_nearness *= 3.0;
  const auto scale = node_scale(arcs.before, arcs.after, 5);
  ASSERT_TRUE(scale);
  EXPECT_NEAR(scale->ratio, 0.8, 0.05);
  EXPECT_GT(scale->spread, 0.03);
  EXPECT_LT(scale->spread, 0.3);
}

TEST(NodeScale, WellKnownDistancesCountMore) {
  TwoArcs arcs = arcs_with(30, 0.5, 0.0);
  for (std::size_t i = 0; i < 20; ++i) {
    arcs.after.matches[i].from_nearness *= 1.5;
    arcs.after.matches[i].distance_spread = 0.4;
  }
  EXPECT_NEAR(node_scale(arcs.before, arcs.after, 5)->ratio, 1.0, 0.01);
}

TEST(NodeScale, ThereIsNoneWithoutWhatItNeeds) {
  TwoArcs few = arcs_with(4, 0.5, 0.0);
  EXPECT_FALSE(node_scale(few.before, few.after, 5));
  TwoArcs far = arcs_with(20, 0.5, 0.0);
  for (ArcMatch& match : far.after.matches) match.from_nearness = 0.0;
  EXPECT_FALSE(node_scale(far.before, far.after, 1));
  TwoArcs turn = arcs_with(20, 0.5, 0.0);
  turn.after.has_baseline = false;
  EXPECT_FALSE(node_scale(turn.before, turn.after, 5));
  Arc empty;
  empty.has_baseline = true;
  EXPECT_FALSE(node_scale(empty, empty, 1));
}

}  // namespace
}  // namespace homeward::repeat::node_scale_test
