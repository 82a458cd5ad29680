// SPDX-License-Identifier: Apache-2.0
#include "features/aggregate.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "support/clustered_features.hpp"

namespace homeward::features::aggregate_test {
namespace {

using homeward::testing::clustered_features;

Vocabulary vocabulary_of(const FeatureSet& set, int words, std::uint64_t seed = 1) {
  const FeatureSet* const sets[] = {&set};
  return train_vocabulary(sets, words, seed).value();
}

/// The words come back in any order.
std::vector<std::vector<float>> sorted_words(const Vocabulary& vocabulary) {
  std::vector<std::vector<float>> words;
  for (Eigen::Index w = 0; w < vocabulary.words.rows(); ++w) {
    const Eigen::VectorXf row = vocabulary.words.row(w);
    words.emplace_back(row.data(), row.data() + row.size());
  }
  std::sort(words.begin(), words.end());
  return words;
}

FeatureSet rows_of(const std::vector<std::vector<int>>& descriptors) {
  FeatureSet set;
  set.bearings.setZero(static_cast<Eigen::Index>(descriptors.size()), 3);
  set.descriptors.resize(static_cast<Eigen::Index>(descriptors.size()), 2);
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    for (std::size_t d = 0; d < 2; ++d) {
      set.descriptors(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(d)) =
          static_cast<std::uint8_t>(descriptors[i][d]);
    }
  }
  return set;
}

TEST(Vocabulary, WordsAreTheMeansOfClusters) {
  const FeatureSet set = rows_of({{10, 10}, {12, 14}, {200, 20}, {204, 24}, {130, 250}, {130, 240}});
  EXPECT_EQ(sorted_words(vocabulary_of(set, 3)), (std::vector<std::vector<float>>{{-117, -116}, {2, 117}, {74, -106}}));
}

TEST(Vocabulary, IsTheSameEachTimeAndAnotherWithAnotherSeed) {
  const FeatureSet set = clustered_features(500, 1);
  EXPECT_EQ(vocabulary_of(set, 16).words, vocabulary_of(set, 16).words);
  EXPECT_NE(vocabulary_of(set, 16, 1).words, vocabulary_of(set, 16, 2).words);
}

TEST(Vocabulary, IsMadeOfASampleOfVeryManyDescriptors) {
  const FeatureSet set = clustered_features(25'000, 1);
  const Vocabulary vocabulary = vocabulary_of(set, 4);
  EXPECT_EQ(vocabulary.words.rows(), 4);
  // The last descriptors count as well: a set whose tail is elsewhere gets words there.
  FeatureSet tailed = set;
  tailed.descriptors.bottomRows(5000).setConstant(255);
  EXPECT_EQ(vocabulary_of(tailed, 4).words.maxCoeff(), 127.0F);
}

TEST(Vocabulary, NamesWhatIsWrong) {
  const FeatureSet few = clustered_features(3, 1);
  const FeatureSet empty;
  FeatureSet shorter = clustered_features(10, 2);
  shorter.descriptors.conservativeResize(Eigen::NoChange, 16);
  const FeatureSet* const sets[] = {&few, &shorter};
  const FeatureSet* const none[] = {&empty};
  EXPECT_EQ(train_vocabulary({sets, 1}, 4, 1).error().code, ErrorCode::kTooFewFeatures);
  EXPECT_TRUE(train_vocabulary({sets, 1}, 3, 1));
  EXPECT_EQ(train_vocabulary(none, 1, 1).error().code, ErrorCode::kTooFewFeatures);
  EXPECT_EQ(train_vocabulary({}, 1, 1).error().code, ErrorCode::kTooFewFeatures);
  EXPECT_EQ(train_vocabulary(sets, 2, 1).error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(train_vocabulary(sets, 0, 1).error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(train_vocabulary(sets, 5000, 1).error().code, ErrorCode::kInvalidInput);
}

TEST(Vocabulary, EqualDescriptorsAreNoTrouble) {
  FeatureSet set = clustered_features(20, 1);
  set.descriptors.setConstant(100);
  const Vocabulary vocabulary = vocabulary_of(set, 4);
  EXPECT_TRUE((vocabulary.words.array() == -28.0F).all());
  EXPECT_TRUE(aggregate(set, vocabulary).isZero());
}

TEST(Aggregate, SumsDifferencesFromTheNearestWord) {
  Vocabulary vocabulary;
  vocabulary.words.resize(3, 2);
  vocabulary.words << 0, 0, 100, 0, 0, 100;
  // Two by the first word: differences (9, 0) and (0, -16); one by the second: (0, 4); none by the third.
  FeatureSet set = rows_of({{128 + 9, 128}, {128, 128 - 16}, {228, 128 + 4}});
  Eigen::VectorXf expected = Eigen::VectorXf::Zero(18);
  expected.segment(6, 6) << 3.0F / 5.0F, -4.0F / 5.0F, 0.0F, 1.0F, 0.0F, 0.0F;
  EXPECT_TRUE(aggregate(set, vocabulary).isApprox(expected / std::sqrt(2.0F)));

  // The same below the horizon, but for one feature above it.
  set.bearings.col(2) << -0.2F, 0.2F, -0.2F;
  expected.setZero();
  expected.segment(0, 6) << 1.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F;
  expected.segment(12, 6) << 0.0F, -1.0F, 0.0F, 0.0F, 0.0F, 0.0F;
  EXPECT_TRUE(aggregate(set, vocabulary).isApprox(expected / std::sqrt(3.0F)));
}

TEST(Aggregate, IsBlindToTheOrderOfFeaturesAndToHeading) {
  const FeatureSet set = clustered_features(700, 3);
  const Vocabulary vocabulary = vocabulary_of(set, 32);
  std::vector<int> order(700);
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  FeatureSet turned = set;
  for (int i = 0; i < 700; ++i) {
    const int from = order[static_cast<std::size_t>(i)];
    turned.descriptors.row(i) = set.descriptors.row(from);
    // ... and to azimuths: a quarter turn.
    turned.bearings.row(i) << -set.bearings(from, 1), set.bearings(from, 0), set.bearings(from, 2);
  }
  EXPECT_EQ(aggregate(set, vocabulary), aggregate(turned, vocabulary));
  EXPECT_NEAR(aggregate(set, vocabulary).norm(), 1.0F, 1e-6F);
}

TEST(Aggregate, NothingGivesZeros) {
  const Vocabulary vocabulary = vocabulary_of(clustered_features(100, 1), 4);
  const Eigen::VectorXf vector = aggregate(FeatureSet{}, vocabulary);
  EXPECT_EQ(vector.size(), vocabulary.aggregate_length());
  EXPECT_TRUE(vector.isZero(0.0F));
}

TEST(Aggregate, PicturesThatShareFeaturesAreNearer) {
  const FeatureSet set = clustered_features(400, 1);
  const Vocabulary vocabulary = vocabulary_of(clustered_features(5000, 7), 16);
  FeatureSet half = clustered_features(400, 2);
  const float stranger = aggregate(set, vocabulary).dot(aggregate(half, vocabulary));
  half.descriptors.topRows(200) = set.descriptors.topRows(200);
  EXPECT_GT(aggregate(set, vocabulary).dot(aggregate(half, vocabulary)), stranger + 0.2F);
}

}  // namespace
}  // namespace homeward::features::aggregate_test
