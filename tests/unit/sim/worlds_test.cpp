// SPDX-License-Identifier: Apache-2.0
#include "sim/generate/worlds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>

#include "sim/floor.hpp"

namespace homeward::sim::worlds_test {
namespace {

void expect_sound(const World& world) {
  const Scene& scene = world.scene;
  ASSERT_GT(scene.triangles.rows(), 100);
  ASSERT_EQ(scene.texture_uv.rows(), scene.vertices_m.rows());
  ASSERT_EQ(std::ssize(scene.triangle_materials), scene.triangles.rows());
  EXPECT_TRUE(scene.vertices_m.allFinite());
  EXPECT_GE(scene.triangles.minCoeff(), 0);
  EXPECT_LT(scene.triangles.maxCoeff(), scene.vertices_m.rows());
  for (const int material : scene.triangle_materials) {
    ASSERT_GE(material, 0);
    ASSERT_LT(material, std::ssize(scene.materials));
  }
  for (const Material& material : scene.materials) EXPECT_LT(material.texture, std::ssize(scene.textures));
  EXPECT_FALSE(world.lamps.empty());
  EXPECT_TRUE(is_set(world.drivable, {world.start.x_m, world.start.y_m}));
}

void expect_rooms_to_be_reachable(const World& world, std::size_t at_least) {
  EXPECT_GE(world.rooms.size(), at_least);
  std::set<std::string> names;
  for (const Room& room : world.rooms) {
    EXPECT_TRUE(names.insert(room.name).second) << room.name << " is there twice";
    EXPECT_TRUE(is_set(world.drivable, {room.x_m, room.y_m})) << room.name;
    EXPECT_EQ(room_at(world, {room.x_m, room.y_m}), room.name);
  }
  const Room& last = world.rooms.back();
  const auto way_m = shortest_way(world.drivable, {world.start.x_m, world.start.y_m}, {last.x_m, last.y_m});
  EXPECT_GT(length_m(way_m), 1.0);
}

bool same_scene(const World& a, const World& b) {
  if (a.scene.vertices_m.rows() != b.scene.vertices_m.rows() || a.scene.vertices_m != b.scene.vertices_m) return false;
  if (a.scene.triangles != b.scene.triangles || a.scene.textures.size() != b.scene.textures.size()) return false;
  for (std::size_t i = 0; i < a.scene.textures.size(); ++i) {
    if (a.scene.textures[i].data != b.scene.textures[i].data) return false;
  }
  return true;
}

class OfficesTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { world_ = std::make_unique<World>(generate_offices(1)); }
  static void TearDownTestSuite() { world_.reset(); }

  static const Room& office(int number) {
    const std::string name = "office_" + std::to_string(number);
    for (const Room& room : world_->rooms) {
      if (room.name == name) return room;
    }
    ADD_FAILURE() << name << " is missing";
    return world_->rooms.front();
  }

  /// Share of an office's floor that is alike in another one, seen through a map of the one's points to the other's.
  template <class ToOther>
  static double alike(const Room& room, const ToOther& to_other) {
    int same = 0;
    int all = 0;
    const Eigen::Vector2d least_m = room.outline_m[0];
    const Eigen::Vector2d most_m = room.outline_m[2];
    for (double x_m = least_m.x() + 0.2; x_m < most_m.x() - 0.2; x_m += 0.05) {
      for (double y_m = least_m.y() + 0.2; y_m < most_m.y() - 0.2; y_m += 0.05) {
        const Eigen::Vector2d point_m(x_m + 0.001, y_m + 0.001);
        ++all;
        same += is_set(world_->occupied, point_m) == is_set(world_->occupied, to_other(point_m)) ? 1 : 0;
      }
    }
    return static_cast<double>(same) / all;
  }

  static std::unique_ptr<World> world_;
};
std::unique_ptr<World> OfficesTest::world_;

TEST_F(OfficesTest, HaveACorridorAndEightOffices) {
  expect_sound(*world_);
  expect_rooms_to_be_reachable(*world_, 9);
  EXPECT_EQ(world_->rooms.front().name, "corridor");
}

TEST_F(OfficesTest, AreTheSameForTheSameSeedAndNotForAnother) {
  EXPECT_TRUE(same_scene(*world_, generate_offices(1)));
  EXPECT_FALSE(same_scene(*world_, generate_offices(2)));
}

TEST_F(OfficesTest, NeighboursOfOneSideLookAlike) {
  const Eigen::Vector2d to_next = office(3).outline_m[0] - office(1).outline_m[0];
  const auto moved = [&](const Eigen::Vector2d& point_m) { return Eigen::Vector2d(point_m + to_next); };
  EXPECT_GT(alike(office(1), moved), 0.97);
}

TEST_F(OfficesTest, TheEighthMirrorsTheSeventh) {
  const double shared_wall_m = office(8).outline_m[0].x();
  const auto mirrored = [&](const Eigen::Vector2d& point_m) {
    return Eigen::Vector2d(2.0 * shared_wall_m - point_m.x(), point_m.y());
  };
  const auto moved = [&](const Eigen::Vector2d& point_m) {
    return Eigen::Vector2d(point_m.x() + office(8).outline_m[0].x() - office(7).outline_m[0].x(), point_m.y());
  };
  EXPECT_GT(alike(office(7), mirrored), 0.95);
  EXPECT_LT(alike(office(7), moved), 0.93);
}

TEST(House, HasAtLeastEightRoomsThatCanAllBeReached) {
  const World house = generate_house(1);
  expect_sound(house);
  expect_rooms_to_be_reachable(house, 8);
}

TEST(House, HasNarrowDoorsWhereTheyAreWanted) {
  const World wide = generate_house(1);
  const World narrow = generate_narrow_house(1);
  EXPECT_EQ(narrow.name, "narrow_house:1");
  expect_sound(narrow);
  expect_rooms_to_be_reachable(narrow, 8);
  // Between two rooms the way of a round body of that radius leads through two doors.
  const auto passes = [](const World& world, double radius_m) {
    const FloorGrid drivable = drivable_cells(world.occupied, radius_m, world.start);
    const auto in_reach = [&](const Room& room) {
      for (double x_m = room.outline_m[0].x(); x_m < room.outline_m[2].x(); x_m += 0.05) {
        for (double y_m = room.outline_m[0].y(); y_m < room.outline_m[2].y(); y_m += 0.05) {
          if (is_set(drivable, {x_m, y_m})) return true;
        }
      }
      return false;
    };
    return std::ranges::count_if(world.rooms, in_reach);
  };
  const auto all = std::ssize(narrow.rooms);
  EXPECT_EQ(passes(narrow, 0.35), all);
  EXPECT_EQ(passes(narrow, 0.44), 1) << "the hall alone";
  EXPECT_EQ(passes(wide, 0.44), all);
}

}  // namespace
}  // namespace homeward::sim::worlds_test
