// SPDX-License-Identifier: Apache-2.0
#include "map/graph.hpp"

#include <gtest/gtest.h>

#include "map/lookup.hpp"
#include "support/ascii_map.hpp"

namespace homeward::map::graph_test {
namespace {

constexpr const char* kTwoFloors = R"(
A-B--C  F-G
  |     |
  D~E   H
)";

std::string reached_from(const TopologicalMap& map, const char* from, int max_hops) {
  const PlaceGraph graph(map);
  std::string text;
  for (const Reached& r : reach(graph, place_indices(map).at(PlaceId(from)), max_hops)) {
    text += map.places[static_cast<std::size_t>(r.place)].id.str() + std::to_string(r.hops);
  }
  return text;
}

TEST(PlaceGraph, CountsComponentsInOrderOfTheirFirstPlace) {
  const TopologicalMap map = testing::ascii_map(kTwoFloors);
  const auto component = components(PlaceGraph(map));
  const auto of = [&](const char* id) {
    return component[static_cast<std::size_t>(place_indices(map).at(PlaceId(id)))];
  };
  EXPECT_EQ(of("A"), 0);
  EXPECT_EQ(of("E"), 0);
  EXPECT_EQ(of("F"), 1);
  EXPECT_EQ(of("H"), 1);
}

TEST(PlaceGraph, ReachesNearPlacesFirst) {
  const TopologicalMap map = testing::ascii_map(kTwoFloors);
  EXPECT_EQ(reached_from(map, "A", 1), "A0B1");
  EXPECT_EQ(reached_from(map, "A", 2), "A0B1C2D2");
  EXPECT_EQ(reached_from(map, "A", 9), "A0B1C2D2E3");
}

TEST(PlaceGraph, FollowsOneWayEdgesForwardsOnly) {
  const TopologicalMap map = testing::ascii_map("A>B>C");
  EXPECT_EQ(reached_from(map, "A", 5), "A0B1C2");
  EXPECT_EQ(reached_from(map, "C", 5), "C0");
}

TEST(PlaceGraph, LeavesOutEdgesThatLeadNowhere) {
  TopologicalMap map = testing::ascii_map("A-B");
  Edge dangling;
  dangling.from = PlaceId("A");
  dangling.to = PlaceId("Z");
  map.edges.push_back(dangling);
  EXPECT_EQ(reached_from(map, "A", 5), "A0B1");
}

TEST(Lookup, FindsThePlaceOfAnImage) {
  const TopologicalMap map = testing::ascii_map("A-B");
  ASSERT_NE(find_place_of(map, ImageId("t/B")), nullptr);
  EXPECT_EQ(find_place_of(map, ImageId("t/B"))->id, PlaceId("B"));
  EXPECT_EQ(find_place_of(map, ImageId("t/Z")), nullptr);
}

}  // namespace
}  // namespace homeward::map::graph_test
