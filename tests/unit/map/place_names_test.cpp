// SPDX-License-Identifier: Apache-2.0
#include "map/place_names.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace homeward::map::place_names_test {
namespace {

using ::testing::ElementsAre;

/// Places p1, p2, ... with these labels, and ways both ways.
TopologicalMap house(const std::vector<std::string>& labels, const std::vector<std::pair<int, int>>& ways) {
  TopologicalMap map;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    Place place;
    place.id = PlaceId("p" + std::to_string(i + 1));
    place.label = labels[i];
    map.places.push_back(place);
  }
  for (const auto& [a, b] : ways) {
    Edge edge;
    edge.from = PlaceId("p" + std::to_string(a));
    edge.to = PlaceId("p" + std::to_string(b));
    map.edges.push_back(edge);
    std::swap(edge.from, edge.to);
    map.edges.push_back(edge);
  }
  return map;
}

TEST(PlaceNames, CountFromTheNearestNamedPlaceTowardsTheNext) {
  const TopologicalMap map = house({"hall", "", "", "", "study"}, {{1, 2}, {2, 3}, {3, 4}, {4, 5}});
  EXPECT_THAT(place_names(map),
              ElementsAre("hall", "first from the hall towards the study", "second from the hall towards the study",
                          "first from the study towards the hall", "study"));
}

TEST(PlaceNames, OfDeadEndsLieBeyond) {
  const TopologicalMap map = house({"Anna's room", "", ""}, {{1, 2}, {2, 3}});
  EXPECT_THAT(place_names(map), ElementsAre("Anna's room", "first past Anna's room", "second past Anna's room"));
}

TEST(PlaceNames, AreThoseOfDestinationsWhereAPlaceHasNone) {
  TopologicalMap map = house({"", ""}, {{1, 2}});
  Destination destination;
  destination.place = PlaceId("p2");
  destination.label = "bed";
  map.destinations.push_back(destination);
  EXPECT_THAT(place_names(map), ElementsAre("first past the bed", "bed"));
}

TEST(PlaceNames, ThatWouldBeAlikeHaveTheIdToo) {
  const TopologicalMap map = house({"hall", "", "", "bath", "bath"}, {{1, 2}, {1, 3}});
  EXPECT_THAT(place_names(map),
              ElementsAre("hall", "first past the hall (p2)", "first past the hall (p3)", "bath (p4)", "bath (p5)"));
}

TEST(PlaceNames, WithoutAnythingNamedAreIds) {
  EXPECT_THAT(place_names(house({"", ""}, {{1, 2}})), ElementsAre("p1", "p2"));
  EXPECT_TRUE(place_names(TopologicalMap()).empty());
}

TEST(PlaceNames, DoNotDependOnIdsOrTheirOrder) {
  const TopologicalMap map = house({"hall", "", "", "", "study"}, {{1, 2}, {2, 3}, {3, 4}, {4, 5}});
  TopologicalMap other = map;
  std::ranges::reverse(other.places);
  std::vector<std::string> names = place_names(other);
  std::ranges::reverse(names);
  EXPECT_EQ(names, place_names(map));
}

TEST(PlaceNames, OfALongCorridorAreAllDifferent) {
  std::vector<std::string> labels(60);
  std::vector<std::pair<int, int>> ways;
  labels.front() = "hall";
  labels.back() = "the study";
  for (int i = 1; i < 60; ++i) ways.emplace_back(i, i + 1);
  const std::vector<std::string> names = place_names(house(labels, ways));
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  EXPECT_EQ(names[22], "22nd from the hall towards the study");
  EXPECT_EQ(names[13], "13th from the hall towards the study");
}

}  // namespace
}  // namespace homeward::map::place_names_test
