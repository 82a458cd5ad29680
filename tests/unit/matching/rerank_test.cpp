// SPDX-License-Identifier: Apache-2.0
#include "matching/rerank.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace homeward::matching::rerank_test {
namespace {

constexpr int kLength = 32;
constexpr int kFeatures = 40;

/// A picture of features drawn by chance.
features::FeatureSet picture(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> byte(0, 255);
  features::FeatureSet set;
  set.bearings.setZero(kFeatures, 3);
  set.scales_rad.setConstant(kFeatures, 0.05F);
  set.descriptors.resize(kFeatures, kLength);
  for (Eigen::Index i = 0; i < set.descriptors.size(); ++i) {
    set.descriptors.data()[i] = static_cast<std::uint8_t>(byte(random));
  }
  return set;
}

/// `from` with every byte changed a little and its features `times` as large.
features::FeatureSet seen_again(features::FeatureSet from, unsigned seed, float times = 1.0F) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> change(-8, 8);
  for (Eigen::Index i = 0; i < from.descriptors.size(); ++i) {
    std::uint8_t& byte = from.descriptors.data()[i];
    byte = static_cast<std::uint8_t>(std::clamp(static_cast<int>(byte) + change(random), 0, 255));
  }
  from.scales_rad *= times;
  return from;
}

std::vector<double> scores_of(const features::FeatureSet& query, const std::vector<features::FeatureSet>& candidates) {
  std::vector<const features::FeatureSet*> pointers;
  for (const features::FeatureSet& candidate : candidates) pointers.push_back(&candidate);
  return rerank(query, pointers, {});
}

std::size_t best(const std::vector<double>& scores) {
  return static_cast<std::size_t>(std::ranges::max_element(scores) - scores.begin());
}

TEST(Rerank, FindsThePictureSeenAgain) {
  std::vector<features::FeatureSet> candidates;
  for (unsigned i = 0; i < 10; ++i) candidates.push_back(picture(i));
  for (unsigned i = 0; i < 10; ++i) EXPECT_EQ(best(scores_of(seen_again(picture(i), 100 + i), candidates)), i);
}

TEST(Rerank, PrefersUnchangedSizes) {
  std::vector<features::FeatureSet> candidates;
  for (unsigned i = 0; i < 8; ++i) candidates.push_back(picture(i));
  const features::FeatureSet query = picture(50);
  candidates[2] = seen_again(query, 1, 2.5F);  // from nearer
  candidates[5] = seen_again(query, 2, 1.1F);
  candidates[6] = seen_again(query, 3, 0.4F);  // from farther
  const auto scores = scores_of(query, candidates);
  EXPECT_EQ(best(scores), 5U);
  EXPECT_GT(scores[5], 2.0 * scores[2]);
  EXPECT_GT(scores[5], 2.0 * scores[6]);
}

TEST(Rerank, WhatAllCandidatesShowSaysNothing) {
  // Half of each picture is the same lamps everywhere; the other half tells them apart.
  const features::FeatureSet lamps = picture(60);
  std::vector<features::FeatureSet> candidates;
  for (unsigned i = 0; i < 8; ++i) {
    candidates.push_back(picture(i));
    candidates.back().descriptors.topRows(kFeatures / 2) = lamps.descriptors.topRows(kFeatures / 2);
  }
  features::FeatureSet query = seen_again(candidates[3], 7);
  query.descriptors.topRows(kFeatures / 2) = lamps.descriptors.topRows(kFeatures / 2);
  EXPECT_EQ(best(scores_of(query, candidates)), 3U);
  // Of the lamps alone nothing is gained anywhere.
  features::FeatureSet only_lamps = lamps;
  only_lamps.descriptors.bottomRows(kFeatures / 2) = lamps.descriptors.topRows(kFeatures / 2);
  for (const double score : scores_of(only_lamps, candidates)) EXPECT_EQ(score, 0.0);
}

TEST(Rerank, NothingToCompareGivesZeros) {
  EXPECT_TRUE(rerank(picture(1), {}, {}).empty());
  features::FeatureSet none = picture(1);
  none.bearings.resize(0, 3);
  none.scales_rad.resize(0);
  none.descriptors.resize(0, kLength);
  features::FeatureSet longer = picture(2);
  longer.descriptors.resize(kFeatures, 2 * kLength);
  longer.descriptors.setZero();
  EXPECT_EQ(scores_of(none, {picture(1), picture(2)}), (std::vector<double>{0.0, 0.0}));
  const auto scores = scores_of(picture(1), {none, picture(1), longer, picture(3)});
  EXPECT_EQ(scores[0], 0.0);
  EXPECT_EQ(scores[2], 0.0);
  EXPECT_EQ(best(scores), 1U);
}

}  // namespace
}  // namespace homeward::matching::rerank_test
