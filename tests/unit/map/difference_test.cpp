// SPDX-License-Identifier: Apache-2.0
#include "map/difference.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/sample_map.hpp"

namespace homeward::map::difference_test {
namespace {

using ::testing::ElementsAre;
using ::testing::SizeIs;

TEST(Difference, AMapDoesNotDifferFromItself) {
  const TopologicalMap map = homeward::testing::sample_map();
  const MapDifference none = difference(map, map);
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(none.parts_before, 1);
  EXPECT_EQ(none.parts_after, 1);
}

TEST(Difference, TellsWhatIsNewGoneAndOther) {
  const TopologicalMap before = homeward::testing::sample_map();
  TopologicalMap after = before;
  after.places[0].members.pop_back();
  after.places[1].label = "pantry";
  Place fresh = before.places[0];
  fresh.id = PlaceId("p3");
  fresh.members = {before.images[1].id};
  after.places.push_back(fresh);
  after.edges[0].blocked = true;
  after.edges.pop_back();
  after.destinations[0].pictogram = "kitchen";
  after.hypotheses[0].decision = Decision::kAccepted;
  const MapDifference found = difference(before, after);
  ASSERT_THAT(found.places, SizeIs(3));
  EXPECT_THAT(found.places[0].left, ElementsAre(before.images[1].id));
  EXPECT_EQ(found.places[1].before->label, "kitchen");
  EXPECT_EQ(found.places[1].after->label, "pantry");
  EXPECT_EQ(found.places[2].id, PlaceId("p3"));
  EXPECT_FALSE(found.places[2].before);
  EXPECT_THAT(found.places[2].gained, ElementsAre(before.images[1].id));
  ASSERT_THAT(found.edges, SizeIs(2));
  EXPECT_TRUE(found.edges[0].after->blocked);
  EXPECT_FALSE(found.edges[1].after);
  EXPECT_EQ(found.edges[1].from, PlaceId("p2"));
  ASSERT_THAT(found.destinations, SizeIs(1));
  ASSERT_THAT(found.hypotheses, SizeIs(1));
  EXPECT_EQ(found.hypotheses[0].before, Decision::kRejected);
  EXPECT_EQ(found.parts_after, 2) << "the new place has no way";
  const MapDifference back = difference(after, before);
  EXPECT_FALSE(back.places.back().after) << "what is gone comes last";
  EXPECT_THAT(back.edges, SizeIs(2));
}

}  // namespace
}  // namespace homeward::map::difference_test
