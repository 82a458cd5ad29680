// SPDX-License-Identifier: Apache-2.0
#include "planning/second_look.hpp"

#include <gtest/gtest.h>

#include "support/ascii_map.hpp"

namespace homeward::planning::second_look_test {
namespace {

using homeward::testing::ascii_map;
using homeward::testing::spelled;

RouteRequest from(const char* place) { return {.from = PlaceId(place), .to = PlaceId(place), .avoid = {}}; }

TEST(SecondLook, LeadsToTheNearestPlaceThatIsFarEnoughAndBack) {
  const auto map = ascii_map(R"(
A--B--C-----D
   |
   E
)");
  const auto look = plan_second_look(map, from("A"), 4.0);
  ASSERT_TRUE(look);
  EXPECT_EQ(spelled(look->places), "A B C B A");
  EXPECT_DOUBLE_EQ(look->length_m, 8.0);
  const auto farther = plan_second_look(map, from("A"), 4.5);
  ASSERT_TRUE(farther);
  EXPECT_EQ(spelled(farther->places), "A B C D C B A");
}

TEST(SecondLook, LeadsEachTimeTwiceAsFarAway) {
  EXPECT_DOUBLE_EQ(second_look_m(0), 5.0);
  EXPECT_DOUBLE_EQ(second_look_m(1), 10.0);
  EXPECT_DOUBLE_EQ(second_look_m(2), 20.0);
}

TEST(SecondLook, MayComeBackAnotherWayAndPassesOverPlacesWithoutAWayBack) {
  const auto round = ascii_map(R"(
A>>B
|  v
C--D
)");
  const auto look = plan_second_look(round, from("A"), 2.5);
  ASSERT_TRUE(look);
  const std::string way = spelled(look->places);
  EXPECT_EQ(way.substr(way.size() - 5), "D C A") << way;
  EXPECT_FALSE(plan_second_look(ascii_map("A>>>>>>B"), from("A"), 5.0)) << "nothing leads back";
}

TEST(SecondLook, DrivesNeitherWhatIsClosedNorWhatIsBlockedOrAvoided) {
  const auto map = ascii_map("C--A--B");
  RouteRequest request = from("A");
  request.closed = {{PlaceId("A"), PlaceId("B")}};
  const auto look = plan_second_look(map, request, 2.0);
  ASSERT_TRUE(look);
  EXPECT_EQ(spelled(look->places), "A C A");
  request.avoid = {PlaceId("C")};
  EXPECT_FALSE(plan_second_look(map, request, 2.0));
  EXPECT_FALSE(plan_second_look(ascii_map("A##B"), from("A"), 1.0));
}

TEST(SecondLook, LeadsToTheFarthestPlaceWhereNoneIsFarEnough) {
  const auto look = plan_second_look(ascii_map("C-A--B>D"), from("A"), 9.0);
  ASSERT_TRUE(look);
  EXPECT_EQ(spelled(look->places), "A B A") << "from D no way leads back";
}

TEST(SecondLook, OfNothingButTheNextMetreIsNone) {
  EXPECT_TRUE(plan_second_look(ascii_map("A--B"), from("A"), 5.0));
  const auto look = plan_second_look(ascii_map("A-B"), from("A"), 5.0);
  ASSERT_FALSE(look);
  EXPECT_EQ(look.error().code, ErrorCode::kNoRoute);
}

TEST(SecondLook, SaysWhereNoWayLeadsAwayAndBack) {
  const auto map = ascii_map("A");
  const auto look = plan_second_look(map, from("A"), 3.0);
  ASSERT_FALSE(look);
  EXPECT_EQ(look.error().code, ErrorCode::kNoRoute);
  EXPECT_NE(look.error().message.find("place A"), std::string::npos) << look.error().message;
  const auto unknown = plan_second_look(map, from("Z"), 5.0);
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, ErrorCode::kUnknownPlace);
}

TEST(SecondLook, SumsWhatBothHalvesCost) {
  const auto map = ascii_map("A~~~~~B");
  const auto look = plan_second_look(map, from("A"), 5.0);
  ASSERT_TRUE(look);
  EXPECT_DOUBLE_EQ(look->length_m, 10.0);
  EXPECT_DOUBLE_EQ(look->cost_m, 30.0);
  EXPECT_GT(look->time_s, 25.0);
  EXPECT_EQ(look->weak.size(), 2U);
  EXPECT_EQ(look->length_from, map::LengthSource::kUnknown);
}

}  // namespace
}  // namespace homeward::planning::second_look_test
