// SPDX-License-Identifier: Apache-2.0
#include "sim/generate/laboratory.hpp"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "sim/floor.hpp"
#include "sim/scene_rays.hpp"

namespace homeward::sim::laboratory_test {
namespace {

LaboratoryState arranged(std::uint64_t arrangement) {
  LaboratoryState state;
  state.arrangement = arrangement;
  return state;
}

/// Corners of all triangles, rounded to a millimetre, with what they are made of.
std::multiset<std::tuple<long, long, long, std::string>> corners_of(const World& world) {
  std::multiset<std::tuple<long, long, long, std::string>> corners;
  for (Eigen::Index i = 0; i < world.scene.vertices_m.rows(); ++i) {
    const auto mm = [&](Eigen::Index axis) { return std::lround(1000.0F * world.scene.vertices_m(i, axis)); };
    const int material = world.scene.triangle_materials[static_cast<std::size_t>(i / 3)];
    corners.emplace(mm(0), mm(1), mm(2), world.scene.materials[static_cast<std::size_t>(material)].name);
  }
  return corners;
}

double share_unmoved(const World& a, const World& b) {
  const auto of_a = corners_of(a);
  const auto of_b = corners_of(b);
  std::vector<std::tuple<long, long, long, std::string>> common;
  std::ranges::set_intersection(of_a, of_b, std::back_inserter(common));
  return static_cast<double>(common.size()) / static_cast<double>(of_a.size());
}

TEST(Laboratory, LeavesTheRowsFreeInEverySeedAndArrangement) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    for (const std::uint64_t arrangement : {0, 1, 2}) {
      const World world = generate_laboratory(seed, arranged(arrangement));
      for (const double along_m : {0.0, 1.5, 3.0, 4.5}) {
        for (const double across_m : {0.0, 0.9, 1.8}) {
          const Pose2 point = laboratory_point(along_m, across_m, 0.0);
          EXPECT_TRUE(is_set(world.drivable, {point.x_m, point.y_m})) << seed << " " << along_m << " " << across_m;
        }
      }
    }
  }
}

TEST(Laboratory, AnotherArrangementMovesTheLightFurnitureAlone) {
  const World before = generate_laboratory(1, arranged(0));
  const World same = generate_laboratory(1, arranged(0));
  const World after = generate_laboratory(1, arranged(1));
  EXPECT_EQ(corners_of(before), corners_of(same));
  ASSERT_EQ(before.scene.triangles.rows(), after.scene.triangles.rows());  // nothing comes, nothing goes
  const double unmoved = share_unmoved(before, after);
  EXPECT_GT(unmoved, 0.2);
  EXPECT_LT(unmoved, 0.8);
  ASSERT_EQ(before.scene.textures.size(), after.scene.textures.size());
  for (std::size_t i = 0; i < before.scene.textures.size(); ++i)
    EXPECT_EQ(before.scene.textures[i].data, after.scene.textures[i].data) << i;
}

TEST(Laboratory, CurtainsDoorAndLampsChangeWhatTheyShould) {
  LaboratoryState state;
  const World closed = generate_laboratory(1, state);
  EXPECT_EQ(closed.lamps.size(), 7U);  // six in the room, one in the corridor
  const raycast::RayScene closed_rays = rays_of(closed.scene);
  const Eigen::Vector3f inside(3.8F, 2.7F, 1.5F);
  const Eigen::Vector3f beyond_the_door(0.68F * 7.6F, -0.5F, 1.5F);
  EXPECT_TRUE(closed_rays.blocked(inside, beyond_the_door));
  state.door_open = true;
  state.only_window_lamps = true;
  const World open = generate_laboratory(1, state);
  EXPECT_FALSE(rays_of(open.scene).blocked(inside, beyond_the_door));
  ASSERT_EQ(open.lamps.size(), 2U);
  for (const Lamp& lamp : open.lamps) EXPECT_LT(lamp.position_m.x(), 2.0);  // the windows are in the wall x = 0
  const Eigen::Vector3f pane(-0.5F, 0.26F * 5.28F + 0.06F, 1.5F);
  const auto first = closed_rays.first_hit(inside, (pane - inside).normalized(), 20.0F);
  ASSERT_TRUE(first);
  EXPECT_EQ(closed.scene.materials[static_cast<std::size_t>(closed.scene.triangle_materials[first->triangle])].name,
            "curtain");
}

TEST(Laboratory, DaylightComesThroughTheWindowsAlone) {
  LaboratoryState state;
  EXPECT_EQ(laboratory_light(state).window_radiance, 0.0F);
  state.daylight = 1.5;
  EXPECT_GT(laboratory_light(state).window_radiance, 1.0F);
  EXPECT_EQ(laboratory_light(state).lamp_intensity, laboratory_light({}).lamp_intensity);
}

}  // namespace
}  // namespace homeward::sim::laboratory_test
