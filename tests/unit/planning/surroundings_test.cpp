// SPDX-License-Identifier: Apache-2.0
#include "planning/surroundings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "support/ascii_map.hpp"
#include "support/landmarks.hpp"

namespace homeward::planning::surroundings_test {
namespace {

using homeward::testing::places;
using homeward::testing::spelled;
using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::Not;

/// The places of a drawing lie where they are drawn: a character is a metre to the right, a row 2 m down.
map::MetricLayout as_drawn(std::string_view drawing) {
  map::MetricLayout layout;
  double x_m = 0.0;
  double y_m = 0.0;
  for (const char c : drawing) {
    if (std::isupper(static_cast<unsigned char>(c)) != 0) {
      layout.emplace(ImageId(std::string("t/") + c), map::LaidOutImage{{x_m, y_m, 0.0}, 0, true});
    }
    x_m = c == '\n' ? 0.0 : x_m + 1.0;
    y_m = c == '\n' ? y_m - 2.0 : y_m;
  }
  return layout;
}

/// What is seen in the middle of a room of its own for each letter. Looks at one room differ by `look`.
features::Appearance look_at(char room, std::uint64_t look) {
  return homeward::testing::seen_from(
      homeward::testing::landmarks_around({Pose2{}}, 60, static_cast<std::uint64_t>(room)), {}, look);
}

void furnish(map::TopologicalMap& map) {
  for (map::Place& place : map.places) place.appearances = {look_at(place.id.str()[0], 1)};
}

map::Place& place_named(map::TopologicalMap& map, char letter) {
  return *std::ranges::find(map.places, PlaceId(std::string(1, letter)), &map::Place::id);
}

/// Each of `as` looks like its counterpart in `rooms`.
void disguise(map::TopologicalMap& map, const std::string& rooms, const std::string& as) {
  for (std::size_t i = 0; i < rooms.size(); ++i) place_named(map, as[i]).appearances = {look_at(rooms[i], 2)};
}

constexpr const char* kFork = R"(
A---B---C---D
    |
    E-F----------G
    |
    H
)";

TEST(Surroundings, AreThePlacesBesideTheRouteNearestFirst) {
  const map::TopologicalMap map = homeward::testing::ascii_map(kFork);
  // From the nearest of the route: D and E 4 m, F 4.5 m, H 8 m and so too far, G 9.8 m.
  EXPECT_EQ(spelled(surroundings(map, places("ABC"), {}, as_drawn(kFork))), "D E F");
  EXPECT_EQ(spelled(surroundings(map, places("ABC"), {}, as_drawn(kFork), {.beside_m = 8.1})), "D E F H");
  EXPECT_THAT(surroundings(map, places("ABC"), {}, as_drawn(kFork), {.beside_m = 3.9}), IsEmpty());
}

TEST(Surroundings, AreAtMostSoManyBesideTheRoute) {
  const map::TopologicalMap map = homeward::testing::ascii_map(kFork);
  EXPECT_EQ(spelled(surroundings(map, places("ABC"), {}, as_drawn(kFork), {.most_beside = 2})), "D E");
  EXPECT_THAT(surroundings(map, places("ABC"), {}, as_drawn(kFork), {.most_beside = 0}), IsEmpty());
}

TEST(Surroundings, HoldNoneOfTheRouteAndNoneTwice) {
  map::TopologicalMap map = homeward::testing::ascii_map(kFork);
  furnish(map);
  disguise(map, "AAB", "CFG");  // on the route, beside it, elsewhere
  const std::vector<PlaceId> chosen =
      surroundings(map, places("ABCA"), {}, as_drawn(kFork), {.alike = 100, .alike_at_end = 0});
  for (const PlaceId& id : places("ABC")) EXPECT_THAT(chosen, Not(Contains(id)));
  std::vector<PlaceId> sorted = chosen;
  std::ranges::sort(sorted);
  EXPECT_EQ(std::ranges::adjacent_find(sorted), sorted.end()) << spelled(chosen);
  EXPECT_EQ(chosen.size(), 5U) << "with so many looked for, all others: " << spelled(chosen);
}

constexpr const char* kTwoWings = R"(
A-B-C-D                              K-L-M-N-O
)";

TEST(Surroundings, AreThePlacesElsewhereThatLookLikeOneOfTheRoute) {
  map::TopologicalMap map = homeward::testing::ascii_map(kTwoWings);
  furnish(map);
  disguise(map, "AC", "NL");
  EXPECT_EQ(spelled(surroundings(map, places("ABC"), {}, as_drawn(kTwoWings), {.alike = 0, .alike_at_end = 0})), "D");
  const std::vector<PlaceId> chosen =
      surroundings(map, places("ABC"), {}, as_drawn(kTwoWings), {.alike = 1, .alike_at_end = 1});
  EXPECT_EQ(chosen.front(), PlaceId("D")) << "those beside it come first";
  EXPECT_THAT(chosen, Contains(PlaceId("N"))) << spelled(chosen);
  EXPECT_THAT(chosen, Contains(PlaceId("L"))) << spelled(chosen);
}

TEST(Surroundings, LookAlikesNeedNoCommonFrame) {
  map::TopologicalMap map = homeward::testing::ascii_map(kTwoWings);
  furnish(map);
  disguise(map, "B", "M");
  map::MetricLayout layout = as_drawn(kTwoWings);
  // Another component: that its numbers are near to the route's says nothing.
  layout.at(ImageId("t/M")) = {{2.0, 0.0, 0.0}, 1, true};
  layout.at(ImageId("t/K")) = {{2.0, 0.0, 0.0}, 1, true};
  layout.erase(ImageId("t/O"));
  EXPECT_EQ(spelled(surroundings(map, places("ABC"), {}, layout, {.alike = 0, .alike_at_end = 0})), "D");
  EXPECT_THAT(surroundings(map, places("B"), {}, layout, {.beside_m = 0.5, .alike_at_end = 1}),
              ::testing::ElementsAre(PlaceId("M")));
}

TEST(Surroundings, ShareTheRoomForLookAlikesAmongAllOfTheRoute) {
  map::TopologicalMap map = homeward::testing::ascii_map(kTwoWings);
  furnish(map);
  disguise(map, "ABCD", "KLMN");
  // The best of each comes before the second best of the first.
  EXPECT_EQ(spelled(surroundings(map, places("ABCD"), {}, as_drawn(kTwoWings),
                                 {.alike = 3, .alike_at_end = 1, .most_alike = 4})),
            "N K L M");
}

TEST(Surroundings, HoldTheLookAlikesOfTheDestinationBeforeThoseOfTheWay) {
  map::TopologicalMap map = homeward::testing::ascii_map(kTwoWings);
  furnish(map);
  disguise(map, "ABDD", "KLMN");
  std::vector<PlaceId> chosen =
      surroundings(map, places("ABCD"), places("C"), as_drawn(kTwoWings), {.alike_at_end = 2, .most_alike = 2});
  std::ranges::sort(chosen);
  EXPECT_EQ(spelled(chosen), "M N") << "with less room than there are steps";
}

TEST(Surroundings, OfPlacesWithoutFeaturesAreThoseBesideTheRoute) {
  map::TopologicalMap map = homeward::testing::ascii_map(kTwoWings);
  EXPECT_EQ(spelled(surroundings(map, places("ABC"), {}, as_drawn(kTwoWings))), "D");
  furnish(map);
  place_named(map, 'A').appearances = {features::Appearance{}};
  place_named(map, 'L').appearances = {features::Appearance{}};
  disguise(map, "B", "M");
  const std::vector<PlaceId> chosen =
      surroundings(map, places("ABC"), {}, as_drawn(kTwoWings), {.alike = 1, .alike_at_end = 1});
  EXPECT_THAT(chosen, Contains(PlaceId("M"))) << spelled(chosen);
  EXPECT_THAT(chosen, Not(Contains(PlaceId("L")))) << spelled(chosen);
}

TEST(Surroundings, OfNothingAreNothing) {
  EXPECT_THAT(surroundings({}, {}, {}, {}), IsEmpty());
  map::TopologicalMap map = homeward::testing::ascii_map(kTwoWings);
  furnish(map);
  EXPECT_THAT(surroundings(map, {}, {}, as_drawn(kTwoWings)), IsEmpty());
  EXPECT_THAT(surroundings(map, places("Z"), {}, as_drawn(kTwoWings)), IsEmpty())
      << "a place that the map does not have";
}

TEST(Surroundings, AreTheSameForTheSameMapAndRoute) {
  map::TopologicalMap map = homeward::testing::ascii_map(kTwoWings);
  furnish(map);
  EXPECT_EQ(surroundings(map, places("ABC"), {}, as_drawn(kTwoWings)),
            surroundings(map, places("ABC"), {}, as_drawn(kTwoWings)));
}

}  // namespace
}  // namespace homeward::planning::surroundings_test
