// SPDX-License-Identifier: Apache-2.0
#include "sim/generate/shut_doors.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/floor.hpp"
#include "sim/generate/worlds.hpp"

namespace homeward::sim {
namespace {

auto count_set(const FloorGrid& grid) { return std::ranges::count(grid.cells, 255); }

bool is_shut(const World& world, const DoorOpening& door) { return is_set(world.occupied, position_m(door.frame)); }

class ShutDoorsOf : public ::testing::TestWithParam<bool> {
 protected:
  const World open_ = GetParam() ? generate_house(3) : generate_offices(3);
};

TEST_P(ShutDoorsOf, AllOfThemAndNothingButTheFirstRoomCanBeDriven) {
  const auto shut = shut_doors(open_, 1.0, 1);
  ASSERT_TRUE(shut);
  EXPECT_EQ(shut->shut, static_cast<int>(open_.doors.size()));
  EXPECT_GE(open_.doors.size(), 8U);
  for (const DoorOpening& door : open_.doors) {
    EXPECT_FALSE(is_shut(open_, door));
    EXPECT_TRUE(is_shut(shut->world, door));
  }
  EXPECT_LT(count_set(shut->world.drivable), count_set(open_.drivable) / 2);
  for (const Room& room : shut->world.rooms)
    EXPECT_EQ(is_set(shut->world.drivable, {room.x_m, room.y_m}), room.name == open_.rooms.front().name) << room.name;
}

TEST_P(ShutDoorsOf, SomeByTheirSeed) {
  const auto once = shut_doors(open_, 0.5, 4);
  const auto again = shut_doors(open_, 0.5, 4);
  const auto other = shut_doors(open_, 0.5, 5);
  ASSERT_TRUE(once && again && other);
  EXPECT_GT(once->shut, 0);
  EXPECT_LT(once->shut, static_cast<int>(open_.doors.size()));
  EXPECT_EQ(once->world.scene.vertices_m, again->world.scene.vertices_m);
  const auto same_door = [&](const DoorOpening& door) {
    return is_shut(once->world, door) == is_shut(other->world, door);
  };
  EXPECT_FALSE(std::ranges::all_of(open_.doors, same_door));
  EXPECT_EQ(once->world.scene.triangles.rows(), static_cast<Eigen::Index>(once->world.scene.triangle_materials.size()));
  EXPECT_LT(once->world.scene.triangles.maxCoeff(), once->world.scene.vertices_m.rows());
}

TEST_P(ShutDoorsOf, NoneWhereNoneIsWanted) {
  const auto shut = shut_doors(open_, 0.0, 1);
  ASSERT_TRUE(shut);
  EXPECT_EQ(shut->shut, 0);
  EXPECT_EQ(shut->world.scene.vertices_m, open_.scene.vertices_m);
}

INSTANTIATE_TEST_SUITE_P(Worlds, ShutDoorsOf, ::testing::Values(true, false));

TEST(ShutDoors, AWorldThatKnowsNoDoorsIsNamed) {
  World world = generate_offices(1);
  world.doors.clear();
  const auto shut = shut_doors(world, 0.5, 1);
  ASSERT_FALSE(shut);
  EXPECT_EQ(shut.error().code, ErrorCode::kInvalidInput);
  EXPECT_EQ(shut.error().where, "offices:1");
}

}  // namespace
}  // namespace homeward::sim
