// SPDX-License-Identifier: Apache-2.0
#include "driving/twin_evidence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace homeward::driving::twin_evidence_test {
namespace {

RecognitionRecord of_pictures(int pictures, double log_share, double variance) {
  RecognitionRecord record;
  for (int k = 0; k < pictures; ++k) take(record, {log_share, variance}, 1.0);
  return record;
}

TEST(TwinEvidence, WhatNobodyHasSeenYetIsAsProbableAsTheBest) {
  EXPECT_EQ(odds_to_best({}, {}, {}), 1.0);
  EXPECT_EQ(odds_to_best({}, of_pictures(20, -1.0, 0.01), {}), 1.0);
}

TEST(TwinEvidence, WhoIsRecognisedBetterHasTheInverseOddsOfTheOther) {
  const RecognitionRecord better = of_pictures(5, -1.0, 0.01);
  const RecognitionRecord worse = of_pictures(5, -1.2, 0.012);
  const double odds = odds_to_best(worse, better, {});
  EXPECT_LT(odds, 0.25);
  EXPECT_NEAR(odds * odds_to_best(better, worse, {}), 1.0, 1e-9);
}

TEST(TwinEvidence, OnAStretchPicturesMisleadTogetherAndOnlyMoreWayTells) {
  const auto odds = [](int pictures) {
    return odds_to_best(of_pictures(pictures, -1.1, 0.01), of_pictures(pictures, -1.0, 0.01), {});
  };
  const double one = std::log(odds(1));
  EXPECT_GT(std::log(odds(8)), 3.0 * one) << "eight pictures of a stretch are no eight witnesses";
  EXPECT_LT(odds(80), 0.2 * odds(8)) << "ten stretches are";
}

TEST(TwinEvidence, ASumThatOnlyWandersTellsNothingHoweverLongTheWay) {
  // What misleads changes from stretch to stretch, with the spread that the settings name.
  const TwinEvidenceConfig config;
  const double variance = 0.01;
  std::mt19937_64 random(3);
  std::normal_distribution<double> unit(0.0, 1.0);
  int surer_than_97_percent = 0;
  constexpr int kWays = 400;
  for (int way = 0; way < kWays; ++way) {
    RecognitionRecord a;
    RecognitionRecord b;
    double misleads = 0.0;
    for (int k = 0; k < 80; ++k) {
      if (k % static_cast<int>(config.lasting_pictures) == 0)
        misleads = std::sqrt(2.0 * variance * config.lasting_variance) * unit(random);
      take(a, {-1.0 + misleads + std::sqrt(variance) * unit(random), variance}, 1.0);
      take(b, {-1.0 + std::sqrt(variance) * unit(random), variance}, 1.0);
    }
    const double odds = odds_to_best(a, b, config);
    if (odds > 0.97 / 0.03 || odds < 0.03 / 0.97) ++surer_than_97_percent;
  }
  EXPECT_LT(surer_than_97_percent, 0.08 * kWays) << "3 % to each side are expected";
}

TEST(TwinEvidence, AYoungerRecordCountsFromWhereItBegan) {
  const RecognitionRecord old = of_pictures(100, -1.0, 0.01);
  RecognitionRecord young{old.log_share, 0.0, 0.0, 0.0};
  RecognitionRecord later = old;
  for (int k = 0; k < 3; ++k) {
    take(young, {-1.0, 0.01}, 1.0);
    take(later, {-3.0, 0.1}, 1.0);
  }
  EXPECT_GT(odds_to_best(young, later, {}), 85.0);
  EXPECT_LT(odds_to_best(later, young, {}), 0.012);
}

TEST(TwinEvidence, AFewPicturesMayMisleadHoweverMuchTheySay) {
  const auto odds = [](int pictures) {
    return odds_to_best(of_pictures(pictures, -9.0, 0.01), of_pictures(pictures, -1.0, 0.01), {});
  };
  EXPECT_NEAR(odds(1), 0.03, 0.005)
      << "of walks beside twins by night 2.5 to 3 % of the clearest pictures name the wrong one";
  EXPECT_LT(odds(4), 0.01);
  EXPECT_LT(odds(12), 2e-4) << "a long way decides";
}

TEST(TwinEvidence, ManyRivalsShareTheProbabilityThatAFewPicturesMisled) {
  const RecognitionRecord worse = of_pictures(1, -9.0, 0.01);
  const RecognitionRecord best = of_pictures(1, -1.0, 0.01);
  EXPECT_NEAR(20.0 * odds_to_best(worse, best, {}, 20), odds_to_best(worse, best, {}), 0.005);
}

TEST(TwinEvidence, NothingIsImpossible) {
  const double odds = odds_to_best(of_pictures(50, -5.0, 0.01), of_pictures(50, -1.0, 0.01), {});
  EXPECT_GT(odds, 0.0);
  EXPECT_LT(odds, 1e-8);
}

}  // namespace
}  // namespace homeward::driving::twin_evidence_test
