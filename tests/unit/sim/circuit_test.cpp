// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "sim/floor.hpp"
#include "sim/generate/worlds.hpp"
#include "sim/tour_path.hpp"

namespace homeward::sim::circuit_test {
namespace {

bool same_scene(const Scene& a, const Scene& b) {
  if (a.vertices_m.rows() != b.vertices_m.rows() || a.vertices_m != b.vertices_m) return false;
  if (a.texture_uv != b.texture_uv || a.textures.size() != b.textures.size()) return false;
  return std::ranges::equal(a.textures, b.textures, {}, &Image::data, &Image::data);
}

/// The ways from each room's point to the next one's, and from the last to the first, for a disc of this radius.
std::vector<std::vector<Eigen::Vector2d>> round_of(const World& world, double radius_m) {
  const FloorGrid floor = drivable_cells(world.occupied, radius_m, world.start);
  std::vector<std::vector<Eigen::Vector2d>> ways_m;
  for (std::size_t i = 0; i < world.rooms.size(); ++i) {
    const Room& from = world.rooms[i];
    const Room& to = world.rooms[(i + 1) % world.rooms.size()];
    EXPECT_TRUE(is_set(floor, {from.x_m, from.y_m})) << from.name;
    ways_m.push_back(shortest_way(floor, {from.x_m, from.y_m}, {to.x_m, to.y_m}));
  }
  return ways_m;
}

class CircuitTest : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(CircuitTest, IsARingThatADiscDrivesRoundWithRoomToSpare) {
  const World world = generate_circuit(GetParam());
  EXPECT_EQ(world.name, "circuit:" + std::to_string(GetParam()));
  ASSERT_EQ(world.rooms.size(), 8U);
  double round_m = 0.0;
  constexpr double kRadius_m = 0.35;
  constexpr double kSpare_m = 0.1;
  for (const auto& way_m : round_of(world, kRadius_m + kSpare_m)) {
    ASSERT_GE(way_m.size(), 2U);
    EXPECT_LE(length_m(way_m), 20.0) << "the other way round";
    round_m += length_m(way_m);
  }
  EXPECT_GE(round_m, 45.0);
  EXPECT_LE(round_m, 70.0);
}

TEST_P(CircuitTest, EachWayToTheNextRoomLeadsThroughNoOther) {
  const World world = generate_circuit(GetParam());
  const auto ways_m = round_of(world, 0.35);
  for (std::size_t i = 0; i < ways_m.size(); ++i) {
    for (const Eigen::Vector2d& point_m : ways_m[i]) {
      const auto room = room_at(world, point_m);
      EXPECT_TRUE(room == world.rooms[i].name || room == world.rooms[(i + 1) % ways_m.size()].name);
    }
  }
}

TEST_P(CircuitTest, HasPlacesThatAreNarrow) {
  const World world = generate_circuit(GetParam());
  const auto narrow = std::ranges::count_if(world.doors, [](const DoorOpening& door) { return door.width_m <= 1.0; });
  EXPECT_EQ(narrow, 2);
  // A body as wide as the frame does not come round.
  const FloorGrid floor = drivable_cells(world.occupied, 0.55, world.start);
  EXPECT_FALSE(std::ranges::all_of(world.rooms, [&](const Room& room) { return is_set(floor, {room.x_m, room.y_m}); }));
}

INSTANTIATE_TEST_SUITE_P(Seeds, CircuitTest, ::testing::Values(1, 2));

TEST(Circuit, IsTheSameForTheSameSeedAndNotForAnother) {
  const World world = generate_circuit(1);
  EXPECT_TRUE(same_scene(world.scene, generate_circuit(1).scene));
  EXPECT_FALSE(same_scene(world.scene, generate_circuit(2).scene));
}

TEST(Circuit, ATourOfAllRoomsGoesRoundAndEndsWhereItBegan) {
  const World world = generate_circuit(1);
  const auto rooms = all_rooms(world);
  ASSERT_EQ(rooms.size(), 9U);
  EXPECT_EQ(rooms.front(), "corridor_1");
  EXPECT_EQ(rooms[7], "corridor_8");
  EXPECT_EQ(rooms.back(), "corridor_1");
  EXPECT_TRUE(plan_tour(world, rooms, 0.4));
}

}  // namespace
}  // namespace homeward::sim::circuit_test
