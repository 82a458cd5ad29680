// SPDX-License-Identifier: Apache-2.0
#include "sim/moved_furniture.hpp"

#include <gtest/gtest.h>

#include <set>

#include "sim/floor.hpp"
#include "sim/generate/worlds.hpp"

namespace homeward::sim::moved_furniture_test {
namespace {

Eigen::Vector2d shift_of(const World& before, const World& after, const Furniture& piece) {
  const auto row = before.scene.triangles(piece.first, 0);
  return (after.scene.vertices_m.row(row) - before.scene.vertices_m.row(row)).head<2>().transpose().cast<double>();
}

class MovedHouse : public ::testing::TestWithParam<int> {
 protected:
  const World house_ = generate_house(static_cast<std::uint64_t>(GetParam()));
};

TEST_P(MovedHouse, HasOnePieceElsewhereInEachRoomAndAllRoomsStayJoined) {
  const auto moved = move_furniture(house_, 1, 0.35, 5);
  ASSERT_TRUE(moved);
  std::multiset<std::string> rooms;
  for (const Furniture& piece : house_.furniture) {
    const double way_m = shift_of(house_, moved->world, piece).norm();
    if (way_m == 0.0) continue;
    EXPECT_TRUE(piece.movable);
    EXPECT_GE(way_m, 0.499);
    EXPECT_LE(way_m, 1.501);
    rooms.insert(piece.room);
  }
  EXPECT_EQ(static_cast<int>(rooms.size()), moved->moved);
  EXPECT_EQ(std::set<std::string>(rooms.begin(), rooms.end()).size(), rooms.size()) << "one in each room";
  EXPECT_GE(rooms.size(), house_.rooms.size() - 1) << "of " << house_.rooms.size();
  EXPECT_EQ(rooms.count(""), 0U);
  for (const Room& room : moved->world.rooms) {
    EXPECT_TRUE(is_set(moved->world.drivable, {room.x_m, room.y_m})) << room.name;
  }
}

TEST_P(MovedHouse, HasTheFloorOfItsScene) {
  const auto moved = move_furniture(house_, 2, 0.35, 3);
  ASSERT_TRUE(moved);
  EXPECT_GT(moved->moved, static_cast<int>(house_.rooms.size()));
  EXPECT_EQ(moved->world.occupied.cells, occupied_cells(moved->world.scene, 0.05).cells);
  EXPECT_NE(moved->world.occupied.cells, house_.occupied.cells);
  EXPECT_EQ(moved->world.drivable.robot_radius_m, house_.drivable.robot_radius_m);
}

INSTANTIATE_TEST_SUITE_P(Seeds, MovedHouse, ::testing::Values(1, 2, 3));

TEST(MovedFurniture, IsTheSameForTheSameSeedAndAnotherForAnother) {
  const World offices = generate_offices(1);
  const auto once = move_furniture(offices, 1, 0.35, 1);
  const auto again = move_furniture(offices, 1, 0.35, 1);
  const auto other = move_furniture(offices, 1, 0.35, 2);
  ASSERT_TRUE(once && again && other);
  EXPECT_GT(once->moved, 5);
  EXPECT_EQ(once->world.scene.vertices_m, again->world.scene.vertices_m);
  EXPECT_NE(once->world.scene.vertices_m, other->world.scene.vertices_m);
}

TEST(MovedFurniture, IsRefusedWhereNobodySaidWhatIsFurniture) {
  World mesh = generate_offices(1);
  mesh.furniture.clear();
  const auto moved = move_furniture(mesh, 1, 0.35, 1);
  ASSERT_FALSE(moved);
  EXPECT_EQ(moved.error().code, ErrorCode::kInvalidInput);
  EXPECT_NE(moved.error().message.find("generated worlds"), std::string::npos);
}

}  // namespace
}  // namespace homeward::sim::moved_furniture_test
