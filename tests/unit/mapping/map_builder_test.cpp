// SPDX-License-Identifier: Apache-2.0
#include "mapping/map_builder.hpp"

#include <gtest/gtest.h>

#include <set>

#include "map/graph.hpp"
#include "map/lookup.hpp"
#include "support/corridor_tour.hpp"

namespace homeward::mapping::map_builder_test {
namespace {

using homeward::testing::corridor_tour;
using homeward::testing::CorridorTour;
using homeward::testing::walk;

const map::Place& place_of(const map::TopologicalMap& map, const ImageId& image) {
  const map::Place* place = map::find_place_of(map, image);
  if (place == nullptr) throw std::out_of_range("no place holds " + image.str());
  return *place;
}

/// What holds for every map.
void expect_whole(const map::TopologicalMap& map, const CorridorTour& tour) {
  std::set<ImageId> held;
  std::set<PlaceId> ids;
  for (const map::Place& place : map.places) {
    EXPECT_TRUE(ids.insert(place.id).second) << place.id.str();
    EXPECT_NE(std::ranges::find(place.members, place.prototype), place.members.end());
    EXPECT_TRUE(std::ranges::is_sorted(place.members));  // tour order: names rise along the tour
    EXPECT_GE(place.appearances.size(), 1U);
    for (const ImageId& member : place.members) EXPECT_TRUE(held.insert(member).second) << member.str();
  }
  EXPECT_EQ(held.size(), tour.images.size());
  for (const map::Edge& edge : map.edges) {
    EXPECT_TRUE(ids.contains(edge.from) && ids.contains(edge.to));
    EXPECT_NE(edge.from, edge.to);
    EXPECT_GT(edge.length_m, 0.0);
    EXPECT_TRUE(std::ranges::any_of(map.edges, [&](const map::Edge& back) {
      return back.from == edge.to && back.to == edge.from && back.length_m == edge.length_m;
    }));
  }
}

TEST(MapBuilder, OneWayBecomesAChainOfPlaces) {
  const CorridorTour tour = corridor_tour(walk(30, false), {30});
  const map::TopologicalMap map = make_map(tour.input(), {}, nullptr);
  expect_whole(map, tour);
  EXPECT_GE(map.places.size(), 5U);
  EXPECT_LE(map.places.size(), 15U);
  EXPECT_EQ(map.edges.size(), 2 * (map.places.size() - 1));
  for (std::size_t i = 0; i < map.places.size(); ++i) EXPECT_EQ(map.places[i].id.str(), "p" + std::to_string(i + 1));
  EXPECT_TRUE(map.hypotheses.empty());
  EXPECT_EQ(map.next_place_number, static_cast<std::int64_t>(map.places.size()) + 1);
  EXPECT_GE(map.motion.hop_spread, 0.5);
  EXPECT_GT(map.motion.distance_spread, 0.0);
}

TEST(MapBuilder, TheWayBackClosesLoops) {
  const CorridorTour tour = corridor_tour(walk(30, true), {60});
  const map::TopologicalMap map = make_map(tour.input(), {}, nullptr);
  expect_whole(map, tour);
  int joined = 0;
  for (std::size_t i = 0; i < 30; ++i) {
    joined += place_of(map, tour.images[i].id).id == place_of(map, tour.images[59 - i].id).id ? 1 : 0;
  }
  EXPECT_GT(joined, 24);
  EXPECT_LE(map.places.size(), 15U);  // and not twice as many as one way
  EXPECT_FALSE(map.hypotheses.empty());
  const auto index = map::image_indices(map);
  for (const map::Place& place : map.places) {
    double least_m = 1e9;
    double most_m = -1e9;
    for (const ImageId& member : place.members) {
      const double at_m = tour.position_m[static_cast<std::size_t>(index.at(member))];
      least_m = std::min(least_m, at_m);
      most_m = std::max(most_m, at_m);
    }
    EXPECT_LT(most_m - least_m, 3.0);
  }
}

TEST(MapBuilder, ALonelyLikenessIsNotALoop) {
  CorridorTour tour = corridor_tour(walk(40, false), {40});
  PairRelation alike;
  alike.distance = 0.02F;  // two doors of one kind, 12 m apart, and nothing around them is alike
  alike.inliers = 40;
  alike.match_share = 0.3F;
  tour.pairs.set(5, 35, alike);
  const map::TopologicalMap map = make_map(tour.input(), {}, nullptr);
  expect_whole(map, tour);
  EXPECT_NE(place_of(map, tour.images[5].id).id, place_of(map, tour.images[35].id).id);
}

TEST(MapBuilder, OdometryGivesLengthsInMetres) {
  CorridorTour tour = corridor_tour(walk(30, false), {30});
  for (std::size_t i = 0; i < 30; ++i) tour.images[i].odometry = Pose2{tour.position_m[i], 0.0, 0.0};
  const map::TopologicalMap map = make_map(tour.input(), {}, nullptr);
  expect_whole(map, tour);
  const auto index = map::image_indices(map);
  const auto at_m = [&](const PlaceId& id) {
    return tour.position_m[static_cast<std::size_t>(index.at(map::find_place(map, id)->prototype))];
  };
  for (const map::Edge& edge : map.edges) {
    EXPECT_NEAR(edge.length_m, std::abs(at_m(edge.from) - at_m(edge.to)), 1e-6);
    ASSERT_TRUE(edge.bearing_rad);
    EXPECT_NEAR(std::abs(*edge.bearing_rad), at_m(edge.to) > at_m(edge.from) ? 0.0 : 3.14, 1e-2);
    EXPECT_FALSE(edge.weak);
  }
}

TEST(MapBuilder, AnUnverifiedEdgeIsWeak) {
  CorridorTour tour = corridor_tour(walk(8, false), {8});
  // Between the fourth and fifth image the tour went through a dark door.
  for (int a = 0; a < 4; ++a) {
    for (int b = 4; b < 8; ++b) tour.pairs.set(a, b, {});
  }
  const map::TopologicalMap map = make_map(tour.input(), {}, nullptr);
  const map::Edge* edge = map::find_edge(map, place_of(map, tour.images[3].id).id, place_of(map, tour.images[4].id).id);
  ASSERT_NE(edge, nullptr);  // it was driven
  EXPECT_TRUE(edge->weak);
  EXPECT_FALSE(edge->bearing_rad);
}

TEST(MapBuilder, MarksBecomeDestinationsAndStayApart) {
  CorridorTour tour = corridor_tour(walk(30, true), {60});
  tour.marks = {{5, "bed"}, {6, "table"}, {53, "table"}};  // 53 is where 6 is
  const map::TopologicalMap map = make_map(tour.input(), {}, nullptr);
  expect_whole(map, tour);
  const map::Place& bed = place_of(map, tour.images[5].id);
  const map::Place& table = place_of(map, tour.images[6].id);
  EXPECT_NE(bed.id, table.id);
  EXPECT_EQ(bed.prototype, tour.images[5].id);
  EXPECT_EQ(bed.label, "bed");
  EXPECT_EQ(table.prototype, tour.images[6].id);
  ASSERT_GE(map.destinations.size(), 2U);
  EXPECT_EQ(map.destinations[0].id.str(), "d1");
  EXPECT_EQ(map.destinations[0].label, "bed");
  EXPECT_EQ(map.destinations[0].place, bed.id);
  EXPECT_EQ(map.destinations[1].image, tour.images[6].id);
  std::set<std::pair<PlaceId, std::string>> different;
  for (const map::Destination& d : map.destinations) EXPECT_TRUE(different.emplace(d.place, d.label).second);
}

TEST(MapBuilder, TwoToursOfOnePartMeet) {
  std::vector<double> position_m = walk(20, false);
  for (int i = 5; i < 25; ++i) position_m.push_back(0.4 * i + 0.05);
  const CorridorTour tour = corridor_tour(position_m, {20, 20});
  const map::TopologicalMap map = make_map(tour.input(), {}, nullptr);
  expect_whole(map, tour);
  int joined = 0;
  for (std::size_t i = 5; i < 20; ++i) {
    joined += place_of(map, tour.images[i].id).id == place_of(map, tour.images[20 + i - 5].id).id ? 1 : 0;
  }
  EXPECT_GT(joined, 8);
  // No edge joins the end of one tour to the start of the next by itself.
  const map::PlaceGraph graph(map);
  EXPECT_EQ(graph.size(), static_cast<int>(map.places.size()));
}

TEST(MapBuilder, PlacesWithNothingInCommonStaySingle) {
  const CorridorTour tour = corridor_tour({0.0, 100.0, 200.0, 300.0}, {4});
  const map::TopologicalMap map = make_map(tour.input(), {}, nullptr);
  expect_whole(map, tour);
  EXPECT_EQ(map.places.size(), 4U);
  EXPECT_EQ(map.edges.size(), 6U);
  for (const map::Edge& edge : map.edges) EXPECT_TRUE(edge.weak);
}

TEST(PairTable, ARelationFromTheOtherSideIsItsInverse) {
  PairTable table(3);
  PairRelation relation;
  relation.inliers = 9;
  relation.direction_rad = 0.5F;
  relation.turn_rad = 1.0F;
  table.set(0, 2, relation);
  const PairRelation back = table.relation(2, 0);
  // b stands at 0.5 rad, turned by 1: from b, a lies at 0.5 + pi - 1.
  EXPECT_NEAR(back.direction_rad, 0.5 + kPi - 1.0, 1e-6);
  EXPECT_NEAR(back.turn_rad, -1.0, 1e-6);
  EXPECT_EQ(table.relation(0, 2).direction_rad, 0.5F);
  EXPECT_EQ(table.distance(1, 1), 0.0F);
  EXPECT_TRUE(std::isinf(table.distance(0, 1)));
  EXPECT_FALSE(table.relation(0, 1).verified());
}

}  // namespace
}  // namespace homeward::mapping::map_builder_test
