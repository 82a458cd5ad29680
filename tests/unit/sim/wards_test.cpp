// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <set>

#include "sim/floor.hpp"
#include "sim/generate/worlds.hpp"
#include "sim/renderer.hpp"
#include "support/sample_cameras.hpp"

namespace homeward::sim::wards_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

bool same_scene(const Scene& a, const Scene& b) {
  if (a.vertices_m.rows() != b.vertices_m.rows() || a.vertices_m != b.vertices_m) return false;
  if (a.texture_uv != b.texture_uv || a.textures.size() != b.textures.size()) return false;
  return std::ranges::equal(a.textures, b.textures, {}, &Image::data, &Image::data);
}

Vector2d size_m(const World& world) {
  Vector2d least_m = Vector2d::Constant(1e9);
  Vector2d most_m = Vector2d::Constant(-1e9);
  for (const Room& room : world.rooms) {
    least_m = least_m.cwiseMin(room.outline_m[0]);
    most_m = most_m.cwiseMax(room.outline_m[2]);
  }
  return most_m - least_m;
}

const Room& room_named(const World& world, const std::string& name) {
  const auto room = std::ranges::find(world.rooms, name, &Room::name);
  if (room != world.rooms.end()) return *room;
  ADD_FAILURE() << name << " is missing";
  return world.rooms.front();
}

int rooms_of_kind(const World& world, const std::string& kind) {
  return static_cast<int>(
      std::ranges::count_if(world.rooms, [&](const Room& room) { return room.name.starts_with(kind + "_"); }));
}

/// How far a texture's coordinates move per metre of a triangle, along u and v.
Vector2d repeats_per_metre(const Scene& scene, Eigen::Index t) {
  Eigen::Matrix<double, 3, 2> edges_m;
  Eigen::Matrix2d edges_uv;
  for (Eigen::Index k = 0; k < 2; ++k) {
    edges_m.col(k) =
        (scene.vertices_m.row(scene.triangles(t, k + 1)) - scene.vertices_m.row(scene.triangles(t, 0))).cast<double>();
    edges_uv.col(k) =
        (scene.texture_uv.row(scene.triangles(t, k + 1)) - scene.texture_uv.row(scene.triangles(t, 0))).cast<double>();
  }
  // Lengths of the gradients of u and v in the triangle's plane.
  const Eigen::Matrix<double, 2, 3> inverse = (edges_m.transpose() * edges_m).inverse() * edges_m.transpose();
  const Eigen::Matrix<double, 2, 3> gradient = edges_uv * inverse;
  return {gradient.row(0).norm(), gradient.row(1).norm()};
}

/// The periods of all faces of a material, in millimetres.
std::set<std::pair<long, long>> periods_mm(const World& world, const std::string& material) {
  std::set<std::pair<long, long>> found;
  for (Eigen::Index t = 0; t < world.scene.triangles.rows(); ++t) {
    const int index = world.scene.triangle_materials[static_cast<std::size_t>(t)];
    if (world.scene.materials[static_cast<std::size_t>(index)].name != material) continue;
    const Vector2d repeats = repeats_per_metre(world.scene, t);
    found.emplace(std::lround(1000.0 / repeats.x()), std::lround(1000.0 / repeats.y()));
  }
  return found;
}

class WardsTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    lit_ = std::make_unique<LitWorld>(generate_wards(1));
    // Evenly lit: what is compared is how things look, and a world's own light takes minutes.
    auto even = std::make_shared<Irradiance>();
    even->corners.setConstant(lit_->fine_scene().vertices_m.rows(), 3, 0.6F);
    camera::CameraConfig sphere = homeward::testing::sphere_camera(192);
    sphere.robot_from_camera_translation_m = {0.0, 0.0, 1.2};
    const auto camera = camera::Camera::create(sphere);
    ASSERT_TRUE(camera);
    renderer_ = std::make_unique<Renderer>(*lit_, light_settings(LightPreset::kDay), even, *camera);
  }
  static void TearDownTestSuite() {
    renderer_.reset();
    lit_.reset();
  }
  static const World& world() { return lit_->world(); }

  /// Where a pose of the southern half is in the northern half, which is the southern one turned round.
  static Pose2 turned(const Pose2& pose) {
    const Vector2d all_m = size_m(world());
    return {all_m.x() - pose.x_m, all_m.y() - pose.y_m, pose.theta_rad + std::numbers::pi};
  }
  static Pose2 pose_in(const std::string& room, double x_m, double y_m) {
    const Vector2d corner_m = room_named(world(), room).outline_m[0];
    return {corner_m.x() + x_m, corner_m.y() + y_m, 0.4};
  }

  /// Mean difference of two pictures in grey levels.
  static double difference(const Pose2& a, const Pose2& b) {
    const Image one = renderer_->render(a, {}, 1);
    const Image other = renderer_->render(b, {}, 1);
    double sum = 0.0;
    for (std::size_t i = 0; i < one.data.size(); ++i) sum += std::abs(int{one.data[i]} - int{other.data[i]});
    return sum / static_cast<double>(one.data.size());
  }

  static std::unique_ptr<LitWorld> lit_;
  static std::unique_ptr<Renderer> renderer_;
};
std::unique_ptr<LitWorld> WardsTest::lit_;
std::unique_ptr<Renderer> WardsTest::renderer_;

TEST_F(WardsTest, AreTheSameForTheSameSeedAndNotForAnother) {
  EXPECT_EQ(world().name, "wards:1");
  EXPECT_TRUE(same_scene(world().scene, generate_wards(1).scene));
  EXPECT_FALSE(same_scene(world().scene, generate_wards(2).scene));
}

TEST_F(WardsTest, AnalogousSpotsOfTwoWardsLookAlike) {
  const Pose2 here = pose_in("ward_1", 3.5, 2.5);
  const Pose2 third = pose_in("ward_3", 3.5, 2.5);
  const double to_another_spot = difference(here, pose_in("ward_1", 4.7, 3.4));
  EXPECT_LT(difference(here, third), 0.35 * to_another_spot);
  EXPECT_LT(difference(here, turned(here)), 0.35 * to_another_spot);
}

TEST_F(WardsTest, TheCorridorsLookAlikeTurnedRound) {
  const Pose2 here = pose_in("corridor_1", 15.0, 1.2);
  EXPECT_LT(difference(here, turned(here)), 0.35 * difference(here, pose_in("corridor_1", 16.2, 1.2)));
}

TEST_F(WardsTest, SomeThingsStandTwiceAndSomeOnce) {
  // By picture and shape of the furniture and of what hangs on walls.
  std::map<int, int> pictures;
  const Scene& scene = world().scene;
  for (Eigen::Index t = 0; t < scene.triangles.rows(); t += 2) {
    const Material& material =
        scene.materials[static_cast<std::size_t>(scene.triangle_materials[static_cast<std::size_t>(t)])];
    if (material.name == "picture") ++pictures[material.texture];
  }
  const auto hanging = [&](int times) {
    return std::ranges::count_if(pictures, [&](const auto& picture) { return picture.second == times; });
  };
  EXPECT_EQ(hanging(2), 2);
  EXPECT_EQ(hanging(1), 2);
}

TEST(Wards, AreLargeAndTheirRoomsCanAllBeReached) {
  for (std::uint64_t seed = 4; seed <= 6; ++seed) {
    SCOPED_TRACE("wards:" + std::to_string(seed));
    const World world = generate_wards(seed);
    const Vector2d all_m = size_m(world);
    EXPECT_GE(all_m.x(), 40.0);
    EXPECT_LE(all_m.x(), 56.0);
    EXPECT_GE(all_m.y(), 20.0);
    EXPECT_LE(all_m.y(), 26.0);
    EXPECT_EQ(rooms_of_kind(world, "corridor"), 2);
    EXPECT_GE(rooms_of_kind(world, "cross"), 2);
    EXPECT_LE(rooms_of_kind(world, "cross"), 4);
    EXPECT_GE(rooms_of_kind(world, "ward"), 10);
    EXPECT_GE(rooms_of_kind(world, "bay"), 8);
    EXPECT_GE(rooms_of_kind(world, "hall"), 1);
    EXPECT_LE(world.rooms.size(), 34U);
    const std::vector<float> clear_m = clearance(world.occupied);
    const FloorGrid roomy = drivable_cells(world.occupied, 0.45, world.start);
    std::set<std::string> names;
    for (const Room& room : world.rooms) {
      EXPECT_TRUE(names.insert(room.name).second) << room.name << " is there twice";
      EXPECT_TRUE(is_set(world.drivable, {room.x_m, room.y_m})) << room.name;
      EXPECT_TRUE(is_set(roomy, {room.x_m, room.y_m})) << room.name;
      EXPECT_EQ(room_at(world, {room.x_m, room.y_m}), room.name);
      // Half the diagonal of a chair of 1.10 m by 0.65 m is 0.64 m: it turns at every room's point.
      const Eigen::Vector2i cell = cell_of(world.occupied, {room.x_m, room.y_m});
      EXPECT_GT(clear_m[static_cast<std::size_t>(cell.y()) * static_cast<std::size_t>(world.occupied.width) +
                        static_cast<std::size_t>(cell.x())],
                0.7F)
          << room.name;
    }
  }
}

TEST(Wards, PatternsRepeatEveryTwoToFiveMetresAndRunOn) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE("wards:" + std::to_string(seed));
    const World world = generate_wards(seed);
    for (const char* material : {"ward wall", "vinyl", "ceiling panels"}) {
      const auto periods = periods_mm(world, material);
      ASSERT_EQ(periods.size(), 1U) << material;
      EXPECT_GE(periods.begin()->first, 2000) << material;
      EXPECT_LE(periods.begin()->first, 5000) << material;
    }
    // Whatever face a floor's point lies on, the pattern there is that of the point's place in the world.
    const double period_m = static_cast<double>(periods_mm(world, "vinyl").begin()->first) / 1000.0;
    const Scene& scene = world.scene;
    for (Eigen::Index t = 0; t < scene.triangles.rows(); ++t) {
      const int index = scene.triangle_materials[static_cast<std::size_t>(t)];
      if (scene.materials[static_cast<std::size_t>(index)].name != "vinyl") continue;
      const Eigen::Index vertex = scene.triangles(t, 0);
      const double along = std::abs(static_cast<double>(scene.texture_uv(vertex, 0)));
      EXPECT_NEAR(along, static_cast<double>(scene.vertices_m(vertex, 0)) / period_m, 0.01);
    }
  }
}

}  // namespace
}  // namespace homeward::sim::wards_test
