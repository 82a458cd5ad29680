// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <memory>
#include <set>

#include "raycast/ray_scene.hpp"
#include "sim/floor.hpp"
#include "sim/generate/worlds.hpp"
#include "sim/scene_rays.hpp"
#include "sim/triangles.hpp"

namespace homeward::sim::systems_laboratory_test {
namespace {

struct Area {
  Eigen::Vector2d least_m = Eigen::Vector2d::Constant(1e9);
  Eigen::Vector2d most_m = Eigen::Vector2d::Constant(-1e9);
};

Area area_of(const World& world, const Furniture& piece) {
  Area area;
  for (Eigen::Index t = piece.first; t < piece.first + piece.count; ++t) {
    for (const Eigen::Vector3d& corner_m : corners_m(world.scene, t)) {
      area.least_m = area.least_m.cwiseMin(corner_m.head<2>());
      area.most_m = area.most_m.cwiseMax(corner_m.head<2>());
    }
  }
  return area;
}

bool overlap(const Area& a, const Area& b) {
  return (a.least_m.array() < b.most_m.array()).all() && (b.least_m.array() < a.most_m.array()).all();
}

class SystemsLaboratoryTest : public ::testing::TestWithParam<std::uint64_t> {
 protected:
  const World world_ = generate_systems_laboratory(GetParam());
};

TEST_P(SystemsLaboratoryTest, IsOneRoomOfTheThesisSize) {
  const FloorExtent extent = floor_extent(world_.scene);
  EXPECT_NEAR(extent.least_m.x(), 0.0, 0.1);
  EXPECT_NEAR(extent.least_m.y(), 0.0, 0.1);
  EXPECT_NEAR(extent.most_m.x(), 10.0, 0.1);
  EXPECT_NEAR(extent.most_m.y(), 12.0, 0.1);
  EXPECT_EQ(world_.name, "laboratory:" + std::to_string(GetParam()));
  EXPECT_EQ(world_.lamps.size(), 6U);
}

TEST_P(SystemsLaboratoryTest, IsDrivableFromTheLowerLeftCornerToEveryQuarter) {
  const std::set<std::string> expected = {"lower_left", "lower_right", "upper_left", "upper_right"};
  std::set<std::string> names;
  EXPECT_TRUE(is_set(world_.drivable, {world_.start.x_m, world_.start.y_m}));
  EXPECT_EQ(room_at(world_, {world_.start.x_m, world_.start.y_m}), "lower_left");
  for (const Room& room : world_.rooms) {
    names.insert(room.name);
    EXPECT_TRUE(is_set(world_.drivable, {room.x_m, room.y_m})) << room.name;
    EXPECT_EQ(room_at(world_, {room.x_m, room.y_m}), room.name);
    const auto way_m = shortest_way(world_.drivable, {world_.start.x_m, world_.start.y_m}, {room.x_m, room.y_m});
    EXPECT_FALSE(way_m.empty()) << room.name;
  }
  EXPECT_EQ(names, expected);
  for (const double x_m : {1.0, 9.0}) EXPECT_TRUE(is_set(world_.drivable, {x_m, 1.0})) << "the corners of the starts";
}

TEST_P(SystemsLaboratoryTest, ItsFurnitureStandsInTheRoomAndNotInOneAnother) {
  ASSERT_EQ(world_.furniture.size(), 25U);  // sixteen along the walls, the study table, eight chairs
  std::vector<Area> areas;
  for (const Furniture& piece : world_.furniture) {
    areas.push_back(area_of(world_, piece));
    EXPECT_GE(areas.back().least_m.minCoeff(), 0.06);
    EXPECT_LE(areas.back().most_m.x(), 9.94);
    EXPECT_LE(areas.back().most_m.y(), 11.94);
    EXPECT_FALSE(piece.room.empty());
  }
  for (std::size_t a = 0; a < areas.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) EXPECT_FALSE(overlap(areas[a], areas[b])) << a << " " << b;
  }
}

TEST_P(SystemsLaboratoryTest, TheStudyTableStandsBetweenItsTwoSides) {
  const raycast::RayScene rays = rays_of(world_.scene);
  const Eigen::Vector3f before(5.0F, 4.0F, 0.3F);
  const Eigen::Vector3f behind(5.0F, 8.0F, 0.3F);
  EXPECT_TRUE(rays.blocked(before, behind)) << "at the height of a scanner";
  EXPECT_FALSE(rays.blocked({5.0F, 4.0F, 1.3F}, {5.0F, 8.0F, 1.3F})) << "at that of a camera";
  EXPECT_TRUE(is_set(world_.drivable, {5.0, 3.9}));
  EXPECT_TRUE(is_set(world_.drivable, {5.0, 8.1}));
  EXPECT_FALSE(is_set(world_.drivable, {5.0, 6.0}));
}

INSTANTIATE_TEST_SUITE_P(Seeds, SystemsLaboratoryTest, ::testing::Values(1, 2, 3, 4, 5));

TEST(SystemsLaboratory, IsTheSameForTheSameSeedAndAnotherForAnother) {
  const World one = generate_systems_laboratory(1);
  const World same = generate_systems_laboratory(1);
  const World other = generate_systems_laboratory(2);
  EXPECT_EQ(one.scene.vertices_m, same.scene.vertices_m);
  ASSERT_EQ(one.scene.textures.size(), same.scene.textures.size());
  for (std::size_t i = 0; i < one.scene.textures.size(); ++i)
    EXPECT_EQ(one.scene.textures[i].data, same.scene.textures[i].data) << i;
  // Furniture is moved a little, and painted anew.
  for (std::size_t i = 0; i < one.furniture.size(); ++i) {
    const Eigen::Vector2d by_m = area_of(other, other.furniture[i]).least_m - area_of(one, one.furniture[i]).least_m;
    EXPECT_GT(by_m.norm(), 0.0) << i;
    EXPECT_LT(by_m.norm(), 1.0) << i;
  }
  EXPECT_NE(one.scene.textures.front().data, other.scene.textures.front().data);
}

}  // namespace
}  // namespace homeward::sim::systems_laboratory_test
