// SPDX-License-Identifier: Apache-2.0
#include "map/lookup.hpp"

#include <gtest/gtest.h>

#include "support/ascii_map.hpp"

namespace homeward::map::lookup_test {
namespace {

TEST(PlacesNamed, AreThoseOfAnIdOrElseOfALabel) {
  TopologicalMap map = homeward::testing::ascii_map("A-B-C");
  map.places[0].label = "kitchen";
  map.places[1].label = "";
  map.places[2].label = "kitchen";
  Destination sink;
  sink.id = DestinationId("d1");
  sink.place = PlaceId("C");
  sink.label = "kitchen";
  map.destinations = {sink};
  EXPECT_EQ(places_named(map, "B"), std::vector<PlaceId>{PlaceId("B")});
  EXPECT_EQ(places_named(map, "kitchen"), (std::vector<PlaceId>{PlaceId("C"), PlaceId("A")}));
  map.places[1].label = "A";  // an id comes before labels
  EXPECT_EQ(places_named(map, "A"), std::vector<PlaceId>{PlaceId("A")});
  EXPECT_EQ(places_labelled(map, "A"), std::vector<PlaceId>{PlaceId("B")});
  EXPECT_TRUE(places_labelled(map, "C").empty()) << "an id is no label";
  EXPECT_TRUE(places_named(map, "cellar").empty());
  map.places[1].label = "";
  EXPECT_TRUE(places_named(map, "").empty()) << "places without a label have no name";
}

}  // namespace
}  // namespace homeward::map::lookup_test
