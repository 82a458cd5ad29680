// SPDX-License-Identifier: Apache-2.0
#include "sim/changed_objects.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/floor.hpp"
#include "sim/generate/worlds.hpp"
#include "sim/scene_objects.hpp"
#include "sim/triangles.hpp"

namespace homeward::sim::changed_objects_test {
namespace {

Eigen::Index triangles_of(const std::vector<SceneObject>& objects) {
  Eigen::Index sum = 0;
  for (const SceneObject& object : objects) sum += static_cast<Eigen::Index>(object.triangles.size());
  return sum;
}

void add_quad(LooseTriangles& mesh, const std::array<Eigen::Vector3f, 4>& corners_m) {
  for (const std::size_t k : {1, 2}) {
    mesh.add({Corner{corners_m[0], {0, 0}}, Corner{corners_m[k], {0, 0}}, Corner{corners_m[k + 1], {0, 0}}}, 0);
  }
}

void add_box(LooseTriangles& mesh, const Eigen::Vector3f& least_m, const Eigen::Vector3f& most_m) {
  const auto corner = [&](int number) {
    return Eigen::Vector3f(number & 1 ? most_m.x() : least_m.x(), number & 2 ? most_m.y() : least_m.y(),
                           number & 4 ? most_m.z() : least_m.z());
  };
  constexpr std::array<std::array<int, 4>, 6> kFaces = {
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& [a, b, c, d] : kFaces) add_quad(mesh, {corner(a), corner(b), corner(c), corner(d)});
}

/// A room of 6 m by 5 m as a mesh: a table with a cup on it, a crate, a rug, a lamp that hangs, a picture, a door.
World mesh_room() {
  LooseTriangles mesh;
  add_box(mesh, {0, 0, -0.1F}, {6, 5, 0});  // floor
  add_box(mesh, {-0.1F, 0, 0}, {0, 5, 2.5F});
  add_box(mesh, {6, 0, 0}, {6.1F, 5, 2.5F});
  add_box(mesh, {0, -0.1F, 0}, {6, 0, 2.5F});
  add_box(mesh, {0, 5, 0}, {6, 5.1F, 2.5F});
  add_box(mesh, {2, 2, 0}, {3.2F, 2.8F, 0.75F});           // table
  add_box(mesh, {2.3F, 2.3F, 0.75F}, {2.4F, 2.4F, 0.9F});  // cup
  add_box(mesh, {4.5F, 3.5F, 0.02F}, {5, 4, 0.5F});        // crate
  add_box(mesh, {1.5F, 1.5F, 0}, {4, 3.5F, 0.01F});        // rug
  add_box(mesh, {3, 1, 2}, {3.3F, 1.3F, 2.4F});            // lamp
  add_box(mesh, {5.95F, 2, 1.2F}, {6, 3, 1.8F});           // picture
  add_box(mesh, {0, 0.5F, 0}, {0.05F, 1.4F, 2});           // door
  World world;
  world.name = "mesh room";
  world.scene = mesh.take();
  world.scene.materials.resize(1);
  world.occupied = occupied_cells(world.scene, 0.05);
  return world;
}

TEST(SceneObjects, OfAGeneratedWorldAreItsFurniture) {
  const World house = generate_house(1);
  const auto objects = objects_of(house);
  ASSERT_EQ(objects.size(), house.furniture.size());
  EXPECT_GT(objects.size(), 20U);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    EXPECT_EQ(objects[i].triangles.size(), static_cast<std::size_t>(house.furniture[i].count));
    EXPECT_EQ(objects[i].movable, house.furniture[i].movable);
  }
}

TEST(SceneObjects, OfAMeshAreWhatStandsOnItsFloor) {
  const auto objects = objects_of(mesh_room());
  ASSERT_EQ(objects.size(), 2U) << "a table with its cup, and a crate";
  EXPECT_EQ(objects[0].triangles.size(), 24U);
  EXPECT_FLOAT_EQ(objects[0].most_m.z(), 0.9F);
  EXPECT_EQ(objects[1].triangles.size(), 12U);
  EXPECT_FLOAT_EQ(objects[1].least_m.x(), 4.5F);
}

TEST(ChangedObjects, WithoutSharesAreAsTheyWere) {
  const World house = generate_house(1);
  const auto changed = change_objects(house, {});
  ASSERT_TRUE(changed);
  EXPECT_EQ(changed->missing + changed->moved, 0);
  EXPECT_EQ(changed->scene.vertices_m, house.scene.vertices_m);
  EXPECT_EQ(changed->scene.triangles, house.scene.triangles);
}

TEST(ChangedObjects, AreLeftOutByTheirShare) {
  const World house = generate_house(1);
  const auto changed = change_objects(house, {0.25, 0.0, 3});
  ASSERT_TRUE(changed);
  EXPECT_EQ(changed->missing, std::lround(0.25 * changed->objects));
  EXPECT_LT(changed->scene.triangles.rows(), house.scene.triangles.rows());
  EXPECT_EQ(changed->scene.triangle_materials.size(), static_cast<std::size_t>(changed->scene.triangles.rows()));
  const auto none_left = change_objects(house, {1.0, 0.0, 3});
  ASSERT_TRUE(none_left);
  EXPECT_EQ(none_left->scene.triangles.rows(), house.scene.triangles.rows() - triangles_of(objects_of(house)));
  EXPECT_EQ(none_left->scene.vertices_m.rows(), 3 * none_left->scene.triangles.rows());
}

TEST(ChangedObjects, AreMovedAndTurnedWithinTheirRooms) {
  const World house = generate_house(2);
  const auto changed = change_objects(house, {0.0, 0.3, 5});
  ASSERT_TRUE(changed);
  const auto objects = objects_of(house);
  ASSERT_GT(changed->moved, 3);
  EXPECT_LE(changed->moved, std::lround(0.3 * changed->objects));
  int moved = 0;
  int turned = 0;
  ASSERT_EQ(changed->scene.triangles.rows(), house.scene.triangles.rows());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const auto corners_before = corners_m(house.scene, objects[i].triangles[0]);
    const auto corners_after = corners_m(changed->scene, objects[i].triangles[0]);
    if (corners_before == corners_after) continue;
    EXPECT_TRUE(objects[i].movable);
    ++moved;
    const Eigen::Vector3d side_before = corners_before[1] - corners_before[0];
    const Eigen::Vector3d side_after = corners_after[1] - corners_after[0];
    EXPECT_NEAR(side_before.norm(), side_after.norm(), 1e-4);
    turned += (side_after - side_before).norm() > 0.01;
    Eigen::Vector2d middle_before = Eigen::Vector2d::Zero();
    Eigen::Vector2d middle_after = Eigen::Vector2d::Zero();
    for (const Eigen::Index t : objects[i].triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        middle_before += corners_m(house.scene, t)[k].head<2>();
        middle_after += corners_m(changed->scene, t)[k].head<2>();
      }
    }
    const double corners = 3.0 * static_cast<double>(objects[i].triangles.size());
    EXPECT_LT((middle_after - middle_before).norm() / corners, 1.5);
    EXPECT_EQ(room_at(house, middle_after / corners), room_at(house, middle_before / corners));
  }
  EXPECT_EQ(moved, changed->moved);
  EXPECT_GT(turned, 0);
}

TEST(ChangedObjects, OfAMeshStayInTheirRoom) {
  const World room = mesh_room();
  const std::vector<SceneObject> objects = objects_of(room);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto changed = change_objects(room, {0.0, 1.0, seed});
    ASSERT_TRUE(changed);
    EXPECT_EQ(changed->objects, 2);
    EXPECT_EQ(changed->moved, 2);
    for (const Eigen::Index t : objects[1].triangles) {
      for (const Eigen::Vector3d& corner_m : corners_m(changed->scene, t)) {
        EXPECT_GT(corner_m.x(), 0.0);
        EXPECT_LT(corner_m.x(), 6.0);
        EXPECT_GT(corner_m.y(), 0.0);
        EXPECT_LT(corner_m.y(), 5.0);
      }
    }
  }
}

TEST(ChangedObjects, AreTheSameForTheSameSeedAndOthersForAnother) {
  const World offices = generate_offices(1);
  const auto once = change_objects(offices, {0.2, 0.2, 1});
  const auto again = change_objects(offices, {0.2, 0.2, 1});
  const auto other = change_objects(offices, {0.2, 0.2, 2});
  ASSERT_TRUE(once && again && other);
  EXPECT_EQ(once->scene.vertices_m, again->scene.vertices_m);
  EXPECT_TRUE(once->scene.vertices_m.rows() != other->scene.vertices_m.rows() ||
              once->scene.vertices_m != other->scene.vertices_m);
}

TEST(ChangedObjects, AreRefusedWhereTheyCannotBe) {
  const World house = generate_house(1);
  for (const ObjectChanges& changes :
       {ObjectChanges{-0.1, 0.0, 1}, ObjectChanges{0.6, 0.6, 1}, ObjectChanges{0.0, std::nan(""), 1}}) {
    const auto changed = change_objects(house, changes);
    ASSERT_FALSE(changed);
    EXPECT_EQ(changed.error().code, ErrorCode::kInvalidInput);
  }
  World bare = mesh_room();
  bare.scene.triangles.conservativeResize(60, 3);  // floor and walls
  const auto changed = change_objects(bare, {0.5, 0.0, 1});
  ASSERT_FALSE(changed);
  EXPECT_EQ(changed.error().code, ErrorCode::kEmptyInput);
  EXPECT_EQ(changed.error().where, "mesh room");
}

}  // namespace
}  // namespace homeward::sim::changed_objects_test
