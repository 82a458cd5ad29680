// SPDX-License-Identifier: Apache-2.0
#include "raycast/ray_scene.hpp"

#include <gtest/gtest.h>

namespace homeward::raycast {
namespace {

/// Two upright squares of 2 m, across the way along x: one at x = 1, the second at x = 3, of glass.
RayScene two_screens() {
  Vertices vertices_m(8, 3);
  vertices_m << 1, -1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1, 3, -1, -1, 3, 1, -1, 3, 1, 1, 3, -1, 1;
  Triangles triangles(4, 3);
  triangles << 0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7;
  return {vertices_m, triangles, {false, false, true, true}};
}

TEST(RayScene, MeetsTheNearerOfTwoScreens) {
  const RayScene scene = two_screens();
  const auto hit = scene.first_hit({0.0F, 0.2F, 0.1F}, Eigen::Vector3f::UnitX(), 10.0F);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance_m, 1.0, 1e-5);
  EXPECT_FALSE(scene.is_pane(hit->triangle));
  const auto behind = scene.first_hit({2.0F, 0.2F, 0.1F}, Eigen::Vector3f::UnitX(), 10.0F);
  ASSERT_TRUE(behind);
  EXPECT_TRUE(scene.is_pane(behind->triangle));
  EXPECT_FALSE(scene.first_hit({0.0F, 0.2F, 0.1F}, Eigen::Vector3f::UnitX(), 0.9F)) << "too far";
  EXPECT_FALSE(scene.first_hit({0.0F, 0.2F, 0.1F}, -Eigen::Vector3f::UnitX(), 10.0F));
}

TEST(RayScene, GivesPacketsTheSameAsSingleRays) {
  const RayScene scene = two_screens();
  RayPacket packet;
  packet.count = 5;
  for (std::size_t i = 0; i < packet.count; ++i) {
    const Eigen::Vector3f direction = Eigen::Vector3f(1.0F, 0.5F * static_cast<float>(i) - 1.0F, 0.1F).normalized();
    packet.x[i] = direction.x();
    packet.y[i] = direction.y();
    packet.z[i] = direction.z();
  }
  const Eigen::Vector3f eye_m(0.0F, 0.13F, 0.0F);  // no ray through the seam of two triangles
  const auto hits = scene.first_hits(eye_m, packet, 10.0F);
  for (std::size_t i = 0; i < packet.count; ++i) {
    const auto one = scene.first_hit(eye_m, packet.direction(i), 10.0F);
    ASSERT_EQ(one.has_value(), hits[i].triangle != Hit::kNoTriangle) << i;
    if (!one) continue;
    EXPECT_EQ(one->triangle, hits[i].triangle);
    EXPECT_NEAR(one->distance_m, hits[i].distance_m, 1e-5);
  }
}

TEST(RayScene, IsBlockedBetweenPointsOnEitherSideOfAScreenAlone) {
  const RayScene scene = two_screens();
  EXPECT_TRUE(scene.blocked({0.0F, 0.0F, 0.0F}, {2.0F, 0.0F, 0.0F}));
  EXPECT_FALSE(scene.blocked({0.0F, 0.0F, 0.0F}, {0.9F, 0.0F, 0.0F}));
  EXPECT_FALSE(scene.blocked({0.0F, 2.0F, 0.0F}, {2.0F, 2.0F, 0.0F})) << "past its edge";
}

TEST(RayScene, WithoutTrianglesBlocksNothing) {
  const RayScene scene(Vertices(0, 3), Triangles(0, 3));
  EXPECT_FALSE(scene.blocked({0.0F, 0.0F, 0.0F}, {9.0F, 0.0F, 0.0F}));
  EXPECT_FALSE(scene.first_hit({0.0F, 0.0F, 0.0F}, Eigen::Vector3f::UnitX(), 10.0F));
  EXPECT_FALSE(scene.is_pane(0));
}

}  // namespace
}  // namespace homeward::raycast
