// SPDX-License-Identifier: Apache-2.0
#include "matching/distinctiveness.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "matching/confidence.hpp"

namespace homeward::matching::distinctiveness_test {
namespace {

using ::testing::ElementsAre;

/// A feature for each number, that many grey levels from those of other numbers.
features::FeatureSet features_of(std::initializer_list<int> numbers) {
  features::FeatureSet set;
  const auto count = static_cast<Eigen::Index>(numbers.size());
  set.bearings.setConstant(count, 3, 1.0F);
  set.descriptors.resize(count, 32);
  Eigen::Index row = 0;
  for (const int number : numbers) set.descriptors.row(row++).setConstant(static_cast<std::uint8_t>(number));
  return set;
}

TEST(DocumentFrequency, CountsPlacesAndNotTheirFeaturesOrAppearances) {
  const features::FeatureSet set = features_of({10, 60, 120});
  const features::FeatureSet by_day = features_of({12, 12, 200});
  const features::FeatureSet by_night = features_of({9});
  const features::FeatureSet other = features_of({61, 13});
  const std::vector<SeenPlace> places = {{&by_day, &by_night}, {&other}};
  EXPECT_THAT(document_frequency(set, places), ElementsAre(2, 1, 0));
}

TEST(DocumentFrequency, NoPlaceAndNoFeatureAreFine) {
  EXPECT_THAT(document_frequency(features_of({10, 60}), {}), ElementsAre(0, 0));
  const features::FeatureSet none;
  const std::vector<SeenPlace> places = {{&none}, {}};
  EXPECT_THAT(document_frequency(features_of({10}), places), ElementsAre(0));
  EXPECT_TRUE(document_frequency(none, places).empty());
}

TEST(DocumentFrequency, StopsAtTheLargestByte) {
  const features::FeatureSet set = features_of({10});
  const std::vector<SeenPlace> places(300, SeenPlace{&set});
  EXPECT_THAT(document_frequency(set, places), ElementsAre(255));
}

TEST(DistinctShare, LooksAtAgreeingSiftMatchesAlone) {
  features::FeatureSet target = features_of({1, 2, 3});
  target.document_frequency = {0, 3, 0};
  const std::vector<Match> matches = {{0, 0}, {1, 1}, {2, 2}, {0, 1, FeatureKind::kColumn}};
  const std::vector<int> inliers = {0, 1, 3};
  EXPECT_DOUBLE_EQ(distinct_share(inliers, matches, target).value(), 1.0 / 7.0);
  EXPECT_DOUBLE_EQ(distinct_share({}, matches, target).value(), 0.0);
}

TEST(DistinctShare, IsNothingWithoutAMap) {
  const std::vector<Match> matches = {{0, 0}};
  const std::vector<int> inliers = {0};
  EXPECT_FALSE(distinct_share(inliers, matches, features_of({1})));
}

TEST(DistinctShare, LowersTheConfidenceAndNeverRaisesIt) {
  ConfidenceSigns signs;
  signs.lead = 100.0;
  signs.around = 0.7;
  signs.median_parallax_rad = 0.2;
  const double alone = confidence(signs);
  ASSERT_GT(alone, 0.8);
  double before = 0.0;
  for (const double share : {0.0, 0.1, 0.3, 0.6, 1.0}) {
    signs.distinct_share = share;
    EXPECT_LT(confidence(signs), alone);
    EXPECT_GT(confidence(signs), before);
    before = confidence(signs);
  }
  EXPECT_NEAR(before, alone, 1e-3);
  signs.distinct_share = 0.0;
  EXPECT_LT(confidence(signs), 0.3);
}

}  // namespace
}  // namespace homeward::matching::distinctiveness_test
