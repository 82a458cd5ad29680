// SPDX-License-Identifier: Apache-2.0
#include "map/turned_layout.hpp"

#include <gtest/gtest.h>

#include "support/ascii_map.hpp"

namespace homeward::map::turned_layout_test {
namespace {

using Drawing = std::vector<Eigen::Vector2d>;

TEST(TurnedLayout, LiesAsTheOtherDrawingDoes) {
  const TopologicalMap other = testing::ascii_map("A B C D");
  const Drawing of_other = {{0.0, 0.5}, {0.5, 0.5}, {1.0, 0.5}, {1.0, 0.8}};
  // The same a quarter turn round, as large as fits, in another order, with a place that the other does not have.
  TopologicalMap map = other;
  std::swap(map.places[0], map.places[2]);
  map.places.push_back(map.places.front());
  map.places.back().id = PlaceId("new");
  const Drawing turned =
      turned_layout(map, {{0.35, 1.0}, {0.35, 0.5}, {0.35, 0.0}, {0.05, 1.0}, {0.65, 0.5}}, other, of_other);
  ASSERT_EQ(turned.size(), 5U);
  const Drawing wanted = {{1.0, 0.5}, {0.5, 0.5}, {0.0, 0.5}, {1.0, 0.8}, {0.5, 0.2}};
  for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_NEAR((turned[i] - wanted[i]).norm(), 0.0, 1e-9) << i;
}

TEST(TurnedLayout, StaysWhereNothingIsInCommon) {
  TopologicalMap map = testing::ascii_map("A B");
  const Drawing drawing = {{0.1, 0.2}, {0.3, 0.4}};
  TopologicalMap other = map;
  other.places[0].id = PlaceId("x");
  other.places[1].id = PlaceId("y");
  EXPECT_EQ(turned_layout(map, drawing, other, {{0.0, 0.0}, {1.0, 1.0}}), drawing);
  EXPECT_EQ(turned_layout(map, drawing, {}, {}), drawing);
  EXPECT_TRUE(turned_layout({}, {}, map, drawing).empty());
}

}  // namespace
}  // namespace homeward::map::turned_layout_test
