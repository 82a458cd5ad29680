// SPDX-License-Identifier: Apache-2.0
#include "wire/mission_order.hpp"

#include <gtest/gtest.h>

#include "planning/route_request.hpp"
#include "support/ascii_map.hpp"
#include "support/sample_map.hpp"
#include "wire/appearance_blob.hpp"
#include "wire/speed_limit.hpp"

namespace homeward::wire::mission_order_test {
namespace {

using homeward::testing::places;

/// A corridor of four places with one beside it, each of which looks its own way, and a picture of its own at D.
map::TopologicalMap corridor() {
  map::TopologicalMap map = testing::ascii_map(R"(
A-B-C-D
  |
  E
)");
  unsigned seed = 0;
  for (map::Place& place : map.places) place.appearances = {testing::random_appearance(5, ++seed)};
  map.destinations.push_back(
      {DestinationId("d1"), PlaceId("D"), ImageId("t/bed"), "bed", testing::random_appearance(5, ++seed)});
  return map;
}

/// Places 2 m apart along x in the order of `letters`, the destination's picture half a metre past D.
map::MetricLayout in_a_row(const std::string& letters, bool metric) {
  map::MetricLayout layout;
  double x_m = 0.0;
  for (const char letter : letters) {
    layout.emplace(ImageId(std::string("t/") + letter), map::LaidOutImage{{x_m, -1.0, 0.25}, 0, metric});
    x_m += 2.0;
  }
  layout.emplace(ImageId("t/bed"), map::LaidOutImage{{6.5, -1.0, 1.5}, 0, metric});
  return layout;
}

TEST(AddSurroundings, TellsWhereThePathLiesInItsOrder) {
  const map::TopologicalMap map = corridor();
  MissionOrder order = order_for_route(map, places("DCBA"), map.destinations[0]);
  EXPECT_FALSE(order.surroundings) << "none before they are added";
  add_surroundings(map, in_a_row("ABCDE", true), places("E"), order);
  ASSERT_TRUE(order.surroundings);
  ASSERT_EQ(order.surroundings->path.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(order.surroundings->path[i].x_m, 6.0 - 2.0 * static_cast<double>(i));
  EXPECT_EQ(order.surroundings->path[0].y_m, -1.0);
  EXPECT_EQ(order.surroundings->path[0].theta_rad, 0.25);
  EXPECT_EQ(order.surroundings->final_pose.x_m, 6.5) << "of the destination's own picture";
  EXPECT_EQ(order.surroundings->final_pose.theta_rad, 1.5);
  ASSERT_EQ(order.surroundings->nearby.size(), 1U);
  const PlacedView& beside = order.surroundings->nearby[0];
  EXPECT_EQ(beside.place, PlaceId("E"));
  EXPECT_EQ(beside.image, ImageId("t/E"));
  EXPECT_EQ(beside.map_from_view.x_m, 8.0);
  EXPECT_EQ(beside.appearance, encode_appearance(map.places[4].appearances.front()));
}

TEST(OrderForRoute, SaysWhichWayNoTourDrove) {
  map::TopologicalMap map = corridor();
  for (map::Edge& edge : map.edges) edge.shortcut = edge.from == PlaceId("B") && edge.to == PlaceId("C");
  const MissionOrder order = order_for_route(map, places("ABC"));
  EXPECT_FALSE(order.path[0].next->shortcut);
  EXPECT_TRUE(order.path[1].next->shortcut);
}

TEST(OrderForRoute, HasWaysThatAPersonDrewDrivenSlowlyUntilTheyAreConfirmed) {
  map::TopologicalMap map = corridor();
  for (map::Edge& edge : map.edges) {
    if (edge.from != PlaceId("B") && edge.from != PlaceId("C")) continue;
    edge.by = map::Decider::kPerson;
    edge.shortcut = edge.from == PlaceId("C");
  }
  EXPECT_FALSE(drawn_by_a_person(map, PlaceId("A"), PlaceId("B")));
  EXPECT_TRUE(drawn_by_a_person(map, PlaceId("B"), PlaceId("C")));
  EXPECT_FALSE(drawn_by_a_person(map, PlaceId("C"), PlaceId("D"))) << "a shortcut was proposed";
  MissionOrder order = order_for_route(map, places("ABCD"));
  EXPECT_FALSE(order.path[0].next->shortcut);
  EXPECT_TRUE(order.path[1].next->shortcut);
  confirm_way(PlaceId("C"), PlaceId("B"), order);
  EXPECT_TRUE(order.path[1].next->shortcut) << "the other direction";
  confirm_way(PlaceId("B"), PlaceId("C"), order);
  EXPECT_FALSE(order.path[1].next->shortcut);
  EXPECT_TRUE(order.path[2].next->shortcut);
}

TEST(AddSurroundings, EndsAtThePrototypeOfAPlaceThatIsNoDestination) {
  const map::TopologicalMap map = corridor();
  MissionOrder order = order_for_route(map, places("ABC"));
  add_surroundings(map, in_a_row("ABCDE", true), {}, order);
  ASSERT_TRUE(order.surroundings);
  EXPECT_EQ(order.surroundings->final_pose.x_m, 4.0);
  EXPECT_EQ(order.surroundings->path.back().x_m, 4.0);
  EXPECT_TRUE(order.surroundings->nearby.empty());
}

TEST(AddSurroundings, SaysHowSurelyTheViewsLieWhereTheyLie) {
  const map::TopologicalMap map = corridor();
  const auto spread_m = [&](const map::MetricLayout& layout) {
    MissionOrder order = order_for_route(map, places("ABCD"), map.destinations[0]);
    add_surroundings(map, layout, places("E"), order);
    return order.surroundings ? order.surroundings->spread_m : 0.0;
  };
  EXPECT_EQ(spread_m(in_a_row("ABCDE", true)), 0.15);
  EXPECT_EQ(spread_m(in_a_row("ABCDE", false)), 0.6);
  // One guess amid the path spoils it, and so does one at its end; one beside it does not.
  for (const auto& [image, expected_m] : {std::pair{"t/B", 0.6}, {"t/bed", 0.6}, {"t/E", 0.15}}) {
    map::MetricLayout layout = in_a_row("ABCDE", true);
    layout.at(ImageId(image)).metric = false;
    EXPECT_EQ(spread_m(layout), expected_m) << image;
  }
}

TEST(AddSurroundings, AddsNothingWhereThePathLiesNowhere) {
  const map::TopologicalMap map = corridor();
  for (const char* image : {"t/A", "t/C", "t/bed"}) {
    MissionOrder order = order_for_route(map, places("ABCD"), map.destinations[0]);
    map::MetricLayout layout = in_a_row("ABCDE", true);
    layout.at(ImageId(image)).component = 1;
    add_surroundings(map, layout, places("E"), order);
    EXPECT_FALSE(order.surroundings) << image << " in a frame of its own";
    layout.erase(ImageId(image));
    add_surroundings(map, layout, places("E"), order);
    EXPECT_FALSE(order.surroundings) << image << " nowhere";
  }
}

TEST(AddSurroundings, LeavesOutWhatLiesNowhere) {
  const map::TopologicalMap map = corridor();
  MissionOrder order = order_for_route(map, places("AB"));
  map::MetricLayout layout = in_a_row("ABCDE", true);
  layout.at(ImageId("t/C")).component = 1;
  layout.erase(ImageId("t/D"));
  add_surroundings(map, layout, places("CDE"), order);
  ASSERT_TRUE(order.surroundings);
  ASSERT_EQ(order.surroundings->nearby.size(), 1U);
  EXPECT_EQ(order.surroundings->nearby[0].place, PlaceId("E"));
}

TEST(AddSurroundings, TellWhichWaysATourDrove) {
  map::TopologicalMap map = corridor();
  for (map::Edge& edge : map.edges) edge.length_from = map::LengthSource::kOdometry;
  const auto ways = [&](const map::MetricLayout& layout) {
    MissionOrder order = order_for_route(map, places("ABC"));
    add_surroundings(map, layout, places("E"), order);
    return order.surroundings->ways;
  };
  const map::MetricLayout near = in_a_row("ABECD", true);
  using Ways = std::vector<std::array<int, 2>>;
  EXPECT_EQ(ways(in_a_row("ABCDE", true)), (Ways{{0, 1}, {1, 2}}))
      << "from B to E it is too far for one straight piece";
  EXPECT_EQ(ways(near), (Ways{{0, 1}, {1, 3}})) << "each once, and from B to C it is too far now";
  const auto change = [&](const char* from, const char* to, auto&& how) {
    for (map::Edge& edge : map.edges) {
      if (edge.from == PlaceId(from) && edge.to == PlaceId(to)) how(edge);
    }
  };
  change("B", "A", [](map::Edge& edge) { edge.blocked = true; });
  EXPECT_EQ(ways(near), (Ways{{1, 3}})) << "what is closed one way may have something on it";
  for (const char* both : {"BE", "EB"}) {
    change(std::string(1, both[0]).c_str(), std::string(1, both[1]).c_str(),
           [](map::Edge& edge) { edge.length_from = map::LengthSource::kUnknown; });
  }
  EXPECT_TRUE(ways(near).empty()) << "nobody measured it";
}

TEST(LeaveOutWay, TakesOutBothDirectionsOfItAndNoOther) {
  map::TopologicalMap map = corridor();
  for (map::Edge& edge : map.edges) edge.length_from = map::LengthSource::kOdometry;
  MissionOrder order = order_for_route(map, places("ABC"));
  leave_out_way(PlaceId("A"), PlaceId("B"), order);
  EXPECT_FALSE(order.surroundings);
  add_surroundings(map, in_a_row("ABECD", true), places("E"), order);
  using Ways = std::vector<std::array<int, 2>>;
  ASSERT_EQ(order.surroundings->ways, (Ways{{0, 1}, {1, 3}}));
  leave_out_way(PlaceId("A"), PlaceId("E"), order);
  leave_out_way(PlaceId("A"), PlaceId("nowhere"), order);
  EXPECT_EQ(order.surroundings->ways.size(), 2U);
  leave_out_way(PlaceId("E"), PlaceId("B"), order);
  EXPECT_EQ(order.surroundings->ways, (Ways{{0, 1}}));
}

TEST(AddSurroundings, NeverMakeAMissionTooLongToBeRead) {
  // 34,000 features take 4.7 MB: path and last picture 14 MB, and with all three others more than three quarters of the
  // 32 MiB of a message.
  map::TopologicalMap map = corridor();
  features::Appearance rich = testing::random_appearance(17'000, 1);
  rich.columns = rich.sift;
  for (map::Place& place : map.places) place.appearances = {rich};
  MissionOrder order = order_for_route(map, places("AB"));
  order.mission = MissionId("m1");
  order.valid_for_ms = 100;
  add_surroundings(map, in_a_row("ABCDE", true), places("ECD"), order);
  ASSERT_TRUE(order.surroundings);
  ASSERT_EQ(order.surroundings->nearby.size(), 2U);
  EXPECT_EQ(order.surroundings->nearby[0].place, PlaceId("E")) << "what comes first matters most";
  const std::vector<std::uint8_t> message = encode(ServerMessage(order));
  EXPECT_LT(message.size(), kMaxLinkMessageBytes);
  EXPECT_TRUE(decode_server_message(message)) << decode_server_message(message).error().message;
}

TEST(AddSurroundings, OfTheLayoutOfAMapGoesOverTheLink) {
  const map::TopologicalMap map = testing::sample_map();
  MissionOrder order = order_for_route(map, std::vector{PlaceId("p1"), PlaceId("p2")}, map.destinations[0]);
  order.mission = MissionId("m1");
  order.map = MapId("house");
  order.valid_for_ms = 500;
  add_surroundings(map, map::metric_layout(map), {}, order);
  ASSERT_TRUE(order.surroundings) << "where the last picture lies, its edges tell";
  EXPECT_EQ(order.surroundings->spread_m, 0.6) << "by their length alone";
  const auto again = decode_server_message(encode(ServerMessage(order)));
  ASSERT_TRUE(again) << again.error().message << " at " << again.error().where;
  EXPECT_EQ(std::get<MissionOrder>(*again).surroundings->path.size(), 2U);
}

TEST(SpeedLimit, IsThePaceThatRoutesAreTimedBy) { EXPECT_EQ(planning::TravelModel{}.speed_mps, kSpeedLimit_mps); }

}  // namespace
}  // namespace homeward::wire::mission_order_test
