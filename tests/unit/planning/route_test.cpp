// SPDX-License-Identifier: Apache-2.0
#include "planning/route.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "core/angles.hpp"
#include "map/lookup.hpp"
#include "planning/no_route.hpp"
#include "support/ascii_map.hpp"

namespace homeward::planning::route_test {
namespace {

using ::testing::HasSubstr;

void expect_route(const map::TopologicalMap& map, const char* from, const char* to, const char* places, double cost_m) {
  const auto route = plan_route(map, {.from = PlaceId(from), .to = PlaceId(to), .avoid = {}});
  ASSERT_TRUE(route) << route.error().message;
  EXPECT_EQ(homeward::testing::spelled(route->places), places);
  EXPECT_DOUBLE_EQ(route->cost_m, cost_m);
}

TEST(PlanRoute, TakesTheShorterWay) {
  const auto map = homeward::testing::ascii_map(R"(
A-B-C
|   |
D---E
)");
  expect_route(map, "A", "E", "A B C E", 3.0);
  expect_route(map, "D", "E", "D E", 3.0);
  expect_route(map, "E", "A", "E C B A", 3.0);
}

TEST(PlanRoute, EndsWhereItStarts) { expect_route(homeward::testing::ascii_map("A-B"), "A", "A", "A", 0.0); }

TEST(PlanRoute, TakesAShortcutForItsLengthAndNamesIt) {
  auto map = homeward::testing::ascii_map(R"(
A--B
|  |
C--D
)");
  for (map::Edge& edge : map.edges) {
    edge.shortcut = (edge.from == PlaceId("A") && edge.to == PlaceId("C")) ||
                    (edge.from == PlaceId("C") && edge.to == PlaceId("A"));
  }
  const RouteRequest request{.from = PlaceId("A"), .to = PlaceId("C"), .avoid = {}};
  const auto route = plan_route(map, request);
  ASSERT_TRUE(route);
  EXPECT_EQ(homeward::testing::spelled(route->places), "A C");
  EXPECT_DOUBLE_EQ(route->cost_m, 1.0);
  EXPECT_DOUBLE_EQ(route->time_s, 1.0 / 0.25);
  ASSERT_EQ(route->shortcuts.size(), 1U);
  EXPECT_EQ(route->shortcuts[0], (Way{PlaceId("A"), PlaceId("C")}));
  RouteRequest closed = request;
  closed.closed = {{PlaceId("A"), PlaceId("C")}};
  EXPECT_EQ(homeward::testing::spelled(plan_route(map, closed)->places), "A B D C");
  EXPECT_TRUE(plan_route(map, closed)->shortcuts.empty());
}

TEST(PlanRoute, PrefersAFirmDetourToAWeakEdge) {
  const auto map = homeward::testing::ascii_map(R"(
A~B
| |
C-D
)");
  // The weak edge counts 3.0 and the detour 3 edges of 1.0: Dijkstra may take either at equal cost, so ask for 4.
  const auto route = plan_route(map, {.from = PlaceId("A"), .to = PlaceId("B"), .avoid = {}, .weak_edge_factor = 4.0});
  ASSERT_TRUE(route);
  EXPECT_EQ(homeward::testing::spelled(route->places), "A C D B");
  const auto direct = plan_route(map, {.from = PlaceId("A"), .to = PlaceId("B"), .avoid = {}, .weak_edge_factor = 2.0});
  ASSERT_TRUE(direct);
  EXPECT_EQ(homeward::testing::spelled(direct->places), "A B");
  EXPECT_DOUBLE_EQ(direct->cost_m, 2.0);
}

TEST(PlanRoute, DoesNotDriveAgainstAOneWayEdge) {
  const auto map = homeward::testing::ascii_map("A>B>C");
  expect_route(map, "A", "C", "A B C", 2.0);
  const auto back = plan_route(map, {.from = PlaceId("C"), .to = PlaceId("A"), .avoid = {}});
  ASSERT_FALSE(back);
  EXPECT_EQ(back.error().code, ErrorCode::kNoRoute);
}

TEST(PlanRoute, DoesNotDriveBlockedEdgesAndSaysSo) {
  const auto map = homeward::testing::ascii_map("A-B#C");
  const auto route = plan_route(map, {.from = PlaceId("A"), .to = PlaceId("C"), .avoid = {}});
  ASSERT_FALSE(route);
  EXPECT_EQ(route.error().code, ErrorCode::kNoRoute);
  EXPECT_THAT(route.error().message, HasSubstr("blocked"));
}

TEST(PlanRoute, GoesRoundPlacesToAvoid) {
  const auto map = homeward::testing::ascii_map(R"(
A-B-C
|   |
D---E
)");
  const auto route = plan_route(map, {.from = PlaceId("A"), .to = PlaceId("C"), .avoid = {PlaceId("B")}});
  ASSERT_TRUE(route);
  EXPECT_EQ(homeward::testing::spelled(route->places), "A D E C");
  EXPECT_FALSE(plan_route(map, {.from = PlaceId("A"), .to = PlaceId("B"), .avoid = {PlaceId("B")}}));
  // Standing on a place to avoid is no reason not to leave it.
  EXPECT_TRUE(plan_route(map, {.from = PlaceId("B"), .to = PlaceId("A"), .avoid = {PlaceId("B")}}));
}

map::Edge& edge_of(map::TopologicalMap& map, const char* from, const char* to) {
  return *map::find_edge(map, PlaceId(from), PlaceId(to));
}

std::string why_not(const map::TopologicalMap& map, const RouteRequest& request) {
  const auto route = plan_route(map, request);
  if (route) return "there is a way: " + homeward::testing::spelled(route->places);
  EXPECT_EQ(route.error().code, ErrorCode::kNoRoute);
  return route.error().message;
}

TEST(PlanRoute, BlockingOneDirectionMakesAnEdgeOneWay) {
  auto map = homeward::testing::ascii_map("A-B-C");
  edge_of(map, "C", "B").blocked = true;
  expect_route(map, "A", "C", "A B C", 2.0);
  EXPECT_EQ(
      why_not(map, {.from = PlaceId("C"), .to = PlaceId("A"), .avoid = {}}),
      "There is no way from C (C) to A (A): the freest leads over the way from C (C) to B (B), which is blocked in "
      "this direction.");
}

TEST(PlanRoute, GoesRoundClosedWays) {
  const auto map = homeward::testing::ascii_map(R"(
A-B-C
|   |
D---E
)");
  RouteRequest request{.from = PlaceId("A"), .to = PlaceId("C"), .avoid = {}};
  request.closed = {{PlaceId("B"), PlaceId("C")}};
  EXPECT_EQ(homeward::testing::spelled(plan_route(map, request)->places), "A D E C");
  request.closed = {{PlaceId("C"), PlaceId("B")}};  // the other direction
  EXPECT_EQ(homeward::testing::spelled(plan_route(map, request)->places), "A B C");
  request.closed = {{PlaceId("B"), PlaceId("p9")}};
  EXPECT_EQ(plan_route(map, request).error().where, "closed");
}

Way way_of(const map::Obstacle& obstacle) { return {obstacle.from, obstacle.to}; }

TEST(PlanRoute, NamesWhatStandsInTheWay) {
  auto map = homeward::testing::ascii_map("A-B#C>D-E");
  RouteRequest request{.from = PlaceId("A"), .to = PlaceId("E"), .avoid = {PlaceId("D")}};
  request.closed = {{PlaceId("A"), PlaceId("B")}};
  const map::NoRoute why = explain_no_route(map, request);
  EXPECT_TRUE(why.connected);
  ASSERT_EQ(why.obstacles.size(), 3U);
  EXPECT_EQ(why.obstacles[0].kind, map::ObstacleKind::kClosed);
  EXPECT_EQ(why.obstacles[1].kind, map::ObstacleKind::kBlocked);
  EXPECT_EQ(way_of(why.obstacles[1]), (Way{PlaceId("B"), PlaceId("C")}));
  EXPECT_EQ(why.obstacles[2].kind, map::ObstacleKind::kAvoided);
  EXPECT_EQ(why.obstacles[2].to, PlaceId("D"));
  const std::string text = why_not(map, request);
  EXPECT_THAT(text, HasSubstr("from A (A) to B (B), which has just failed or is closed, the way from B (B) to C (C), "
                              "which is blocked and place D (D), which is to be avoided"));
  const map::NoRoute back = explain_no_route(map, {.from = PlaceId("E"), .to = PlaceId("C"), .avoid = {}});
  ASSERT_EQ(back.obstacles.size(), 1U);
  EXPECT_EQ(back.obstacles[0].kind, map::ObstacleKind::kOneWay);
  EXPECT_EQ(way_of(back.obstacles[0]), (Way{PlaceId("D"), PlaceId("C")}));
}

TEST(PlanRoute, NamesTheFewestObstacles) {
  const auto map = homeward::testing::ascii_map(R"(
A#B#C
x   x
D---E
)");
  // Above two blocked edges, below two as well; with E to avoid the upper way has fewer.
  const map::NoRoute why = explain_no_route(map, {.from = PlaceId("A"), .to = PlaceId("C"), .avoid = {PlaceId("E")}});
  ASSERT_EQ(why.obstacles.size(), 2U);
  EXPECT_EQ(way_of(why.obstacles[0]), (Way{PlaceId("A"), PlaceId("B")}));
  EXPECT_EQ(way_of(why.obstacles[1]), (Way{PlaceId("B"), PlaceId("C")}));
}

TEST(PlanRoute, ByTimeAWeakShortcutAndTurnsCost) {
  auto map = homeward::testing::ascii_map(R"(
A~~B
|  |
C--D
)");
  RouteRequest request{.from = PlaceId("A"), .to = PlaceId("B"), .avoid = {}, .by = RouteCost::kTime};
  request.travel = {.speed_mps = 0.5, .turn_radps = 1.0, .weak_speed_share = 0.5};
  auto route = plan_route(map, request);
  ASSERT_TRUE(route);
  EXPECT_EQ(homeward::testing::spelled(route->places), "A B");
  EXPECT_DOUBLE_EQ(route->length_m, 2.0);
  EXPECT_DOUBLE_EQ(route->time_s, 8.0);
  EXPECT_EQ(route->weak, (std::vector<Way>{{PlaceId("A"), PlaceId("B")}}));
  request.travel.weak_speed_share = 0.25;  // 16 s against 8 s
  route = plan_route(map, request);
  EXPECT_EQ(homeward::testing::spelled(route->places), "A C D B");
  EXPECT_DOUBLE_EQ(route->time_s, 8.0);
  EXPECT_TRUE(route->weak.empty());
  // All headings north; two quarter turns at 0.1 rad/s make the detour take 31 s longer.
  edge_of(map, "A", "C").bearing_rad = kPi;
  edge_of(map, "A", "C").turn_rad = 0.0;
  edge_of(map, "C", "D").bearing_rad = -kPi / 2.0;
  edge_of(map, "C", "D").turn_rad = 0.0;
  edge_of(map, "D", "B").bearing_rad = 0.0;
  edge_of(map, "D", "B").turn_rad = 0.0;
  request.travel.turn_radps = 0.1;
  EXPECT_EQ(homeward::testing::spelled(plan_route(map, request)->places), "A B");
  request.closed = {{PlaceId("A"), PlaceId("B")}};
  EXPECT_NEAR(plan_route(map, request)->time_s, 8.0 + 10.0 * kPi, 1e-9);
  request.travel.speed_mps = 0.0;
  EXPECT_EQ(plan_route(map, request).error().code, ErrorCode::kInvalidInput);
}

TEST(PlanRoutes, GivesTheNextBestWays) {
  const auto map = homeward::testing::ascii_map(R"(
A-B-C
| | |
D-E-F
)");
  const auto routes = plan_routes(map, {.from = PlaceId("A"), .to = PlaceId("F"), .avoid = {}}, 10);
  ASSERT_TRUE(routes);
  std::set<std::string> different;
  for (std::size_t i = 0; i < routes->size(); ++i) {
    const auto& places = (*routes)[i].places;
    EXPECT_EQ(std::set<PlaceId>(places.begin(), places.end()).size(), places.size());
    EXPECT_TRUE(different.insert(homeward::testing::spelled(places)).second);
    if (i > 0) {
      EXPECT_GE((*routes)[i].cost_m, (*routes)[i - 1].cost_m);
    }
  }
  // Three ways of 3 edges, one of 5: all that pass no place twice.
  EXPECT_EQ(different, (std::set<std::string>{"A B C F", "A B E F", "A D E F", "A D E B C F"}));
  EXPECT_EQ(plan_routes(map, {.from = PlaceId("A"), .to = PlaceId("A"), .avoid = {}}, 3)->size(), 1U);
  EXPECT_EQ(plan_routes(map, {.from = PlaceId("A"), .to = PlaceId("F"), .avoid = {}}, 0).error().where, "count");
}

TEST(PlanRoutes, NoPlaceComesTwiceWhereTurnsMakeARoundCheap) {
  // At B the way to D turns back sharply; round over C no turn is known.
  auto map = homeward::testing::ascii_map(R"(
A--B-C
   |
   D
)");
  edge_of(map, "A", "B").bearing_rad = 0.0;
  edge_of(map, "A", "B").turn_rad = 0.0;
  edge_of(map, "B", "D").bearing_rad = kPi;
  RouteRequest request{.from = PlaceId("A"), .to = PlaceId("D"), .avoid = {}, .by = RouteCost::kTime};
  request.travel.turn_radps = 0.01;
  const auto route = plan_route(map, request);
  ASSERT_TRUE(route);
  EXPECT_EQ(homeward::testing::spelled(route->places), "A B D");
  EXPECT_GT(route->time_s, 300.0);
}

TEST(PlanRoute, SaysThatPartsAreNotConnected) {
  const auto route =
      plan_route(homeward::testing::ascii_map("A-B C-D"), {.from = PlaceId("A"), .to = PlaceId("D"), .avoid = {}});
  ASSERT_FALSE(route);
  EXPECT_EQ(route.error().code, ErrorCode::kNoRoute);
  EXPECT_THAT(route.error().message, HasSubstr("not connected"));
}

TEST(PlanRoute, NamesAPlaceThatDoesNotExist) {
  const auto map = homeward::testing::ascii_map("A-B");
  const auto route = plan_route(map, {.from = PlaceId("A"), .to = PlaceId("p99"), .avoid = {}});
  ASSERT_FALSE(route);
  EXPECT_EQ(route.error().code, ErrorCode::kUnknownPlace);
  EXPECT_THAT(route.error().message, HasSubstr("p99"));
  EXPECT_EQ(route.error().where, "to");
}

}  // namespace
}  // namespace homeward::planning::route_test
