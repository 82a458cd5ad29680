// SPDX-License-Identifier: Apache-2.0
#include "planning/route.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/ascii_map.hpp"

namespace homeward::planning {
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
}  // namespace homeward::planning
