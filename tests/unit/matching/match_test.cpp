// SPDX-License-Identifier: Apache-2.0
#include "matching/match.hpp"

#include <gtest/gtest.h>

#include "support/sample_map.hpp"

namespace homeward::matching::match_test {
namespace {

/// Features with the given descriptors (padded with zeros) and no colour.
features::FeatureSet features_of(const std::vector<std::vector<int>>& descriptors) {
  features::FeatureSet set;
  const auto count = static_cast<Eigen::Index>(descriptors.size());
  set.bearings.setZero(count, 3);
  set.scales_rad.setZero(count);
  set.descriptors.setZero(count, 8);
  set.colours.setZero(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& row = descriptors[static_cast<std::size_t>(i)];
    for (std::size_t d = 0; d < row.size(); ++d) {
      set.descriptors(i, static_cast<Eigen::Index>(d)) = static_cast<std::uint8_t>(row[d]);
    }
  }
  return set;
}

std::vector<std::pair<int, int>> pairs(const std::vector<Match>& matches) {
  std::vector<std::pair<int, int>> result;
  for (const Match& match : matches) result.emplace_back(match.current, match.target);
  return result;
}

using Pairs = std::vector<std::pair<int, int>>;

TEST(Match, TakesNearestNeighboursOfEachOther) {
  const auto current = features_of({{200, 0}, {0, 200}, {100, 100}});
  const auto target = features_of({{0, 205}, {105, 100}, {200, 5}});
  EXPECT_EQ(pairs(match(current, target, {})), (Pairs{{0, 2}, {1, 0}, {2, 1}}));
}

TEST(Match, OneSidedLikingIsNoMatch) {
  // Both current features like the only near target; it likes the first one better.
  const auto current = features_of({{10, 0}, {20, 0}});
  const auto target = features_of({{9, 0}, {250, 250}});
  EXPECT_EQ(pairs(match(current, target, {})), (Pairs{{0, 0}}));
}

TEST(Match, TheSecondBestMustBeClearlyWorse) {
  const auto current = features_of({{100, 0}});
  MatchConfig config;
  config.ratio = 0.8;
  EXPECT_EQ(match(current, features_of({{100, 7}, {100, 10}}), config).size(), 1U);  // 0.7
  EXPECT_EQ(match(current, features_of({{100, 9}, {100, 10}}), config).size(), 0U);  // 0.9
  config.ratio = 0.95;
  EXPECT_EQ(match(current, features_of({{100, 9}, {100, 10}}), config).size(), 1U);
}

TEST(Match, SaysHowFarBehindTheSecondBestIs) {
  const auto current = features_of({{100, 0}});
  EXPECT_FLOAT_EQ(match(current, features_of({{100, 7}, {100, 10}}), {}).at(0).ratio, 0.7F);
  EXPECT_FLOAT_EQ(match(current, features_of({{100, 0}, {100, 10}}), {}).at(0).ratio, 0.0F);
  EXPECT_LT(match(current, features_of({{100, 7}}), {}).at(0).ratio, 0.001F);  // nothing else at all
}

TEST(Match, TwoPerfectOnesAreOneTooMany) {
  const auto current = features_of({{100, 0}});
  EXPECT_EQ(match(current, features_of({{100, 0}, {100, 0}}), {}).size(), 0U);
  EXPECT_EQ(match(current, features_of({{100, 0}, {100, 1}}), {}).size(), 1U);
}

TEST(Match, ColoursMustAgree) {
  auto current = features_of({{100, 0}});
  auto target = features_of({{100, 1}, {0, 200}});
  current.colours.row(0) << 100, -100, 50;
  target.colours.row(0) << 20, -50, 0;  // 80, 50, 50 apart
  MatchConfig config;
  config.max_colour_difference = 80;
  EXPECT_EQ(match(current, target, config).size(), 1U);
  config.max_colour_difference = 79;
  EXPECT_EQ(match(current, target, config).size(), 0U);
  target.colours.row(0) << 100, 127, 50;  // 227 apart: must not wrap in 8 bits
  EXPECT_EQ(match(current, target, config).size(), 0U);
}

TEST(Match, NothingMatchesNothing) {
  const auto some = features_of({{1, 2}});
  const features::FeatureSet none;
  EXPECT_TRUE(match(none, some, {}).empty());
  EXPECT_TRUE(match(some, none, {}).empty());
  EXPECT_TRUE(match(none, none, {}).empty());
  auto other = some;
  other.descriptors.setZero(1, 4);  // of another kind
  EXPECT_TRUE(match(some, other, {}).empty());
}

TEST(Match, FindsAllOfAShuffledCopyAndIsTheSameFromTheOtherSide) {
  const auto current = homeward::testing::random_appearance(150, 3).sift;
  auto target = current;
  std::mt19937 random(8);
  std::vector<int> order(150);
  for (int i = 0; i < 150; ++i) order[static_cast<std::size_t>(i)] = i;
  std::ranges::shuffle(order, random);
  for (int i = 0; i < 150; ++i) {
    const int from = order[static_cast<std::size_t>(i)];
    target.descriptors.row(i) = current.descriptors.row(from);
    target.colours.row(i) = current.colours.row(from);
    target.descriptors(i, i % 128) ^= 7U;
  }
  const auto forth = match(current, target, {});
  ASSERT_EQ(forth.size(), 150U);
  for (std::size_t i = 0; i < forth.size(); ++i) {
    EXPECT_EQ(forth[i].current, static_cast<int>(i));
    EXPECT_EQ(order[static_cast<std::size_t>(forth[i].target)], forth[i].current);
  }
  EXPECT_EQ(match(target, current, {}).size(), 150U);
}

}  // namespace
}  // namespace homeward::matching::match_test
