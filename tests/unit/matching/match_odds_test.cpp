// SPDX-License-Identifier: Apache-2.0
#include "matching/match_odds.hpp"

#include <gtest/gtest.h>

namespace homeward::matching::match_odds_test {
namespace {

double odds(double ratio, FeatureKind kind) { return odds_of({0, 0, kind, static_cast<float>(ratio)}); }

TEST(MatchOdds, FallWithTheRatioAndCrossOneInsideWhatTheRatioTestLeaves) {
  for (const FeatureKind kind : {FeatureKind::kSift, FeatureKind::kColumn}) {
    for (double ratio = 0.0; ratio < 0.95; ratio += 0.05) EXPECT_GE(odds(ratio, kind), odds(ratio + 0.05, kind));
    EXPECT_GT(odds(0.5, kind), 1.0);
    EXPECT_LT(odds(0.79, kind), 1.0);
  }
}

TEST(MatchOdds, NothingIsSureByItsLooksAlone) {
  for (const FeatureKind kind : {FeatureKind::kSift, FeatureKind::kColumn}) {
    EXPECT_LE(odds(0.0, kind), 8.0);
    EXPECT_DOUBLE_EQ(odds(0.0, kind), odds(0.1, kind));
    EXPECT_GT(odds(1.0, kind), 0.1);
  }
}

TEST(MatchOdds, OfAColumnSayLessThanOfASiftFeature) {
  const auto reach = [](FeatureKind kind) { return odds(0.5, kind) / odds(0.8, kind); };
  EXPECT_GT(reach(FeatureKind::kSift), 1.5 * reach(FeatureKind::kColumn));
}

}  // namespace
}  // namespace homeward::matching::match_odds_test
