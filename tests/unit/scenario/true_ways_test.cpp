// SPDX-License-Identifier: Apache-2.0
#include "scenario/true_ways.hpp"

#include <gtest/gtest.h>

#include "support/ascii_map.hpp"
#include "support/box_world.hpp"

namespace homeward::scenario::true_ways_test {
namespace {

/// A round of four places, 2 m apart; the way straight from A to C is a shortcut.
struct Round {
  Round() {
    map = testing::ascii_map(R"(
A--B
|  |
C--D
)");
    for (map::Edge& edge : map.edges) {
      edge.shortcut =
          edge.from != PlaceId("B") && edge.from != PlaceId("D") && edge.to != PlaceId("B") && edge.to != PlaceId("D");
    }
    const std::pair<const char*, Pose2> at[] = {
        {"t/A", {0.0, 2.0, 0.0}}, {"t/B", {2.0, 2.0, 0.0}}, {"t/C", {0.0, 0.0, 0.0}}, {"t/D", {2.0, 0.0, 0.0}}};
    for (const auto& [image, pose] : at) poses.emplace(ImageId(image), pose);
    bed.place = PlaceId("C");
    bed.image = ImageId("t/bed");
    poses.emplace(bed.image, Pose2{0.0, -0.5, 0.0});
  }
  [[nodiscard]] std::optional<double> way_m(double x_m, double y_m, bool shortcuts) const {
    return way_over_edges_m(map, poses, {x_m, y_m}, bed, shortcuts);
  }
  map::TopologicalMap map;
  PicturePoses poses;
  map::Destination bed;
};

TEST(TrueWays, GoOverTheEdgesThatTheTourDrove) {
  const Round round;
  EXPECT_DOUBLE_EQ(round.way_m(0.0, 2.0, false).value(), 6.5);
  EXPECT_DOUBLE_EQ(round.way_m(0.0, 2.0, true).value(), 2.5);
  EXPECT_DOUBLE_EQ(round.way_m(0.0, 2.25, true).value(), 2.75);
}

TEST(TrueWays, BeginAtTheNearestPlaceWhereNoneIsWithinAMetre) {
  const Round round;
  EXPECT_DOUBLE_EQ(round.way_m(0.0, 5.0, false).value(), 9.5);
  EXPECT_DOUBLE_EQ(round.way_m(1.25, 2.0, false).value(), 5.25);
}

TEST(TrueWays, SayNothingWhereThereIsNone) {
  Round round;
  for (map::Edge& edge : round.map.edges) edge.blocked = true;
  EXPECT_FALSE(round.way_m(0.0, 2.0, true));
  Round unknown;
  unknown.poses.erase(ImageId("t/bed"));
  EXPECT_FALSE(unknown.way_m(0.0, 2.0, true));
}

TEST(TrueWays, TellWhetherABodyGetsAlongStraight) {
  const sim::World world = testing::box_world(true);
  const sim::Obstacles obstacles(world);
  const sim::RobotProfile disc = sim::disc_profile();
  EXPECT_LT(clearance_along_m(obstacles, disc, {-1.0, 0.7, 0.0}, {1.0, 0.7, 0.0}), 0.0);
  EXPECT_NEAR(clearance_along_m(obstacles, disc, {-1.0, -0.75, 0.0}, {1.0, -0.75, 0.0}), 0.4, 0.06);
}

}  // namespace
}  // namespace homeward::scenario::true_ways_test
