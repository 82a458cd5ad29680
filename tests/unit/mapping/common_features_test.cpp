// SPDX-License-Identifier: Apache-2.0
#include "mapping/common_features.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "support/sample_map.hpp"

namespace homeward::mapping::common_features_test {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Places 0 to `count` - 1 in a row, `length_m` apart; each with features of its own.
map::TopologicalMap row_of(int count, double length_m) {
  map::TopologicalMap map;
  for (int i = 0; i < count; ++i) {
    map::Place place = testing::place_of_image("p" + std::to_string(i), ImageId("tour/" + std::to_string(i) + ".jpg"),
                                               testing::random_appearance(10, static_cast<unsigned>(i)));
    map.images.push_back({place.prototype, {}, {}});
    if (i > 0) {
      map::Edge edge;
      edge.from = map.places.back().id;
      edge.to = place.id;
      edge.length_m = length_m;
      edge.length_from = map::LengthSource::kOdometry;
      map.edges.push_back(edge);
    }
    map.places.push_back(std::move(place));
  }
  return map;
}

TEST(FarPlaces, AreTheLengthOfTheWayApart) {
  EXPECT_THAT(far_places(row_of(6, 4.0), {}), ElementsAre(ElementsAre(3, 4, 5), ElementsAre(4, 5), ElementsAre(5),
                                                          ElementsAre(0), ElementsAre(0, 1), ElementsAre(0, 1, 2)));
}

TEST(FarPlaces, AreCountedInEdgesWhereLengthsAreNoMetres) {
  map::TopologicalMap map = row_of(14, 4.0);
  map.edges[4].length_from = map::LengthSource::kTourImages;
  EXPECT_THAT(far_places(map, {})[0], ElementsAre(12, 13));
}

TEST(FarPlaces, AreJoinedAndNoLoopBetweenThemIsUndecided) {
  map::TopologicalMap map = row_of(6, 4.0);
  map::Hypothesis hypothesis;
  hypothesis.prototype_a = map.places[5].prototype;
  hypothesis.prototype_b = map.places[0].prototype;
  map.hypotheses = {hypothesis};
  EXPECT_THAT(far_places(map, {})[0], ElementsAre(3, 4));
  map.hypotheses[0].decision = map::Decision::kRejected;
  EXPECT_THAT(far_places(map, {})[0], ElementsAre(3, 4, 5));
  map.edges.erase(map.edges.begin() + 3);  // 4 and 5 may be anywhere
  EXPECT_THAT(far_places(map, {})[0], ElementsAre(3));
}

TEST(CommonFeatures, OfFarPlacesThatLookAlikeAreCounted) {
  map::TopologicalMap map = row_of(6, 4.0);
  map.places[5].appearances = map.places[0].appearances;
  map.places[1].appearances = map.places[0].appearances;  // near: that it looks alike is no wonder
  map::Destination destination;
  destination.place = map.places[0].id;
  destination.appearance = map.places[0].appearances.front();
  map.destinations = {destination};
  ASSERT_TRUE(count_common_features(map, {}, 1, {}));
  const auto frequency = [&](int place) {
    return map.places[static_cast<std::size_t>(place)].appearances.front().sift.document_frequency;
  };
  EXPECT_THAT(frequency(0), Each(1));
  EXPECT_THAT(frequency(5), Each(2));
  EXPECT_THAT(frequency(2), Each(0));
  EXPECT_THAT(map.destinations[0].appearance.sift.document_frequency, Each(1));
}

TEST(CommonFeatures, AreTheSameWithAnyNumberOfThreadsAndWithFewLookAlikesOnly) {
  map::TopologicalMap one = row_of(40, 4.0);
  for (int i = 30; i < 34; ++i) one.places[static_cast<std::size_t>(i)].appearances = one.places[0].appearances;
  map::TopologicalMap three = one;
  const CommonFeaturesConfig config{.most_places = 5};
  ASSERT_TRUE(count_common_features(one, config, 1, {}));
  ASSERT_TRUE(count_common_features(three, config, 3, {}));
  for (std::size_t p = 0; p < one.places.size(); ++p) {
    EXPECT_EQ(one.places[p].appearances[0].sift.document_frequency,
              three.places[p].appearances[0].sift.document_frequency);
  }
  EXPECT_THAT(one.places[0].appearances[0].sift.document_frequency, Each(4));
}

TEST(CommonFeatures, AreNotKnownWhereNothingIsFar) {
  map::TopologicalMap map = row_of(2, 4.0);
  ASSERT_TRUE(count_common_features(map, {}, 1, {}));
  EXPECT_THAT(map.places[0].appearances[0].sift.document_frequency, IsEmpty());
}

}  // namespace
}  // namespace homeward::mapping::common_features_test
