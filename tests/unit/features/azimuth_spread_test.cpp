// SPDX-License-Identifier: Apache-2.0
#include "features/azimuth_spread.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace homeward::features::azimuth_spread_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(AzimuthSpread, ASectorGetsItsSecondOnlyWhenAllHadTheirFirst) {
  const std::vector<RankedFeature> found = {{0.9, 3}, {0.8, 3}, {0.1, 7}, {0.7, 3}, {0.2, 0}};
  EXPECT_THAT(spread_over_azimuth(found, 4), ElementsAre(4, 0, 2, 1));
}

TEST(AzimuthSpread, AmongEquallyStrongOnesTheFirstWins) {
  const std::vector<RankedFeature> found = {{0.5, 1}, {0.5, 1}, {0.5, 1}};
  EXPECT_THAT(spread_over_azimuth(found, 2), ElementsAre(0, 1));
}

TEST(AzimuthSpread, NeverGivesMoreThanThereAreNorThanTheBudget) {
  const std::vector<RankedFeature> found = {{0.5, -1}, {0.4, kAzimuthSectors}};
  EXPECT_EQ(spread_over_azimuth(found, 9).size(), 2U);
  EXPECT_THAT(spread_over_azimuth(found, 0), IsEmpty());
  EXPECT_THAT(spread_over_azimuth({}, 5), IsEmpty());
}

}  // namespace
}  // namespace homeward::features::azimuth_spread_test
