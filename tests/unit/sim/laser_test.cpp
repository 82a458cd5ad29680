// SPDX-License-Identifier: Apache-2.0
#include "sim/laser.hpp"

#include <gtest/gtest.h>

#include "sim/scene_rays.hpp"
#include "support/box_world.hpp"

namespace homeward::sim::laser_test {
namespace {

constexpr double kNoNoise_m = 1e-9;

TEST(Laser, MeasuresABoxRoomExactly) {
  const World world = homeward::testing::box_world();
  const raycast::RayScene rays = rays_of(world.scene);
  LaserConfig config;
  config.noise_m = kNoNoise_m;
  const Pose2 robot{0.3, -0.2, 0.7};
  const std::vector<float> ranges_m = scan(rays, robot, {}, config, 1);
  ASSERT_EQ(ranges_m.size(), 360U);
  for (int i = 0; i < 360; ++i) {
    const double angle_rad = robot.theta_rad + 2.0 * kPi * i / 360.0;
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    const double to_x_m = ((c > 0.0 ? 2.0 : -2.0) - robot.x_m) / c;
    const double to_y_m = ((s > 0.0 ? 1.5 : -1.5) - robot.y_m) / s;
    EXPECT_NEAR(ranges_m[static_cast<std::size_t>(i)], std::min(to_x_m, to_y_m), 1e-4) << i;
  }
}

TEST(Laser, SeesNothingBeyondItsRange) {
  const World world = homeward::testing::box_world();
  const raycast::RayScene rays = rays_of(world.scene);
  LaserConfig config;
  config.noise_m = kNoNoise_m;
  config.range_max_m = 1.6;
  config.rays = 4;
  const std::vector<float> ranges_m = scan(rays, {}, {}, config, 1);
  EXPECT_TRUE(std::isinf(ranges_m[0]));
  EXPECT_NEAR(ranges_m[1], 1.5, 1e-4);  // left
  EXPECT_TRUE(std::isinf(ranges_m[2]));
  EXPECT_NEAR(ranges_m[3], 1.5, 1e-4);
}

TEST(Laser, SeesPeopleBeforeWalls) {
  const World world = homeward::testing::box_world();
  const raycast::RayScene rays = rays_of(world.scene);
  LaserConfig config;
  config.noise_m = kNoNoise_m;
  config.rays = 4;
  const std::vector<float> ranges_m = scan(rays, {}, {{1.0, 0.0, 3}}, config, 1);
  EXPECT_NEAR(ranges_m[0], 1.0 - kPersonRadius_m, 1e-4);
  EXPECT_NEAR(ranges_m[2], 2.0, 1e-4);
}

TEST(Laser, TakesTheShortestOfItsLayers) {
  SceneBuilder builder;
  const Surface grey{builder.add_material("grey", std::array{0.5F, 0.5F, 0.5F}), 0.0};
  builder.box({}, {1.0, -1.0, 0.6}, {1.2, 1.0, 0.8}, {grey, grey});  // a table top
  builder.box({}, {2.0, -1.0, 0.0}, {2.2, 1.0, 2.0}, {grey, grey});  // a wall behind it
  const raycast::RayScene rays = rays_of(builder.take());
  LaserConfig config;
  config.noise_m = kNoNoise_m;
  config.rays = 1;
  EXPECT_NEAR(scan(rays, {}, {}, config, 1)[0], 2.0, 1e-4);  // below the table
  config.heights_m = {0.3, 0.7};
  EXPECT_NEAR(scan(rays, {}, {}, config, 1)[0], 1.0, 1e-4);
}

TEST(Laser, ItsNoiseHasTheStatedSpreadAndComesFromTheSeed) {
  const World world = homeward::testing::box_world();
  const raycast::RayScene rays = rays_of(world.scene);
  LaserConfig config;
  config.noise_m = kNoNoise_m;
  const auto exact = scan(rays, {}, {}, config, 1);
  config.noise_m = 0.02;
  const auto noisy = scan(rays, {}, {}, config, 1);
  EXPECT_EQ(noisy, scan(rays, {}, {}, config, 1));
  EXPECT_NE(noisy, scan(rays, {}, {}, config, 2));
  double sum2 = 0.0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double error_m = static_cast<double>(noisy[i] - exact[i]);
    sum2 += error_m * error_m;
  }
  EXPECT_NEAR(std::sqrt(sum2 / static_cast<double>(exact.size())), 0.02, 0.003);
}

/// A room of the box world's size whose wall ahead is one pane.
raycast::RayScene room_with_a_pane() {
  SceneBuilder builder;
  const Surface grey{builder.add_material("grey", std::array{0.5F, 0.5F, 0.5F}), 0.0};
  const Surface pane{builder.add_material("window", std::array{0.5F, 0.5F, 0.5F}, MaterialRole::kWindow), 0.0};
  builder.box({}, {2.0, -1.5, 0.0}, {2.1, 1.5, 2.5}, {pane, pane});
  builder.box({}, {-2.1, -1.5, 0.0}, {-2.0, 1.5, 2.5}, {grey, grey});
  builder.box({}, {-2.0, 1.5, 0.0}, {2.0, 1.6, 2.5}, {grey, grey});
  builder.box({}, {-2.0, -1.6, 0.0}, {2.0, -1.5, 2.5}, {grey, grey});
  return rays_of(builder.take());
}

TEST(Laser, GoesThroughTheStatedShareOfPanesAlone) {
  const raycast::RayScene rays = room_with_a_pane();
  LaserConfig config;
  config.rays = 3600;
  const auto solid = scan(rays, {}, {}, config, 1);
  config.glass_share = 0.3;
  const auto glass = scan(rays, {}, {}, config, 1);
  EXPECT_EQ(glass, scan(rays, {}, {}, config, 1));
  int at_pane = 0;
  int through = 0;
  for (std::size_t i = 0; i < solid.size(); ++i) {
    ASSERT_TRUE(std::isfinite(solid[i]));
    const double angle_rad = 2.0 * kPi * static_cast<double>(i) / 3600.0;
    const bool pane = std::abs(std::tan(angle_rad)) < 0.749 && std::cos(angle_rad) > 0.0;
    if (pane) ++at_pane;
    if (pane && std::isinf(glass[i])) {
      ++through;
    } else {
      EXPECT_EQ(glass[i], solid[i]) << i;  // the same noise too
    }
  }
  EXPECT_NEAR(static_cast<double>(through) / at_pane, 0.3, 0.05);  // of 738: 3 standard deviations
  config.glass_share = 1.0;
  EXPECT_TRUE(std::isinf(scan(rays, {}, {}, config, 1)[0]));
  EXPECT_NEAR(scan(rays, {}, {{1.0, 0.0, 3}}, config, 1)[0], 1.0 - kPersonRadius_m, 0.05);  // before the pane
}

TEST(Laser, GivesTheStatedShareOfSpuriousRanges) {
  const World world = homeward::testing::box_world();
  const raycast::RayScene rays = rays_of(world.scene);
  LaserConfig config;
  config.rays = 3600;
  const auto clean = scan(rays, {}, {}, config, 1);
  config.spurious_share = 0.05;
  const auto bad = scan(rays, {}, {}, config, 1);
  EXPECT_EQ(bad, scan(rays, {}, {}, config, 1));
  EXPECT_NE(bad, scan(rays, {}, {}, config, 2));
  int spurious = 0;
  float least_m = 100.0F;
  float most_m = 0.0F;
  for (std::size_t i = 0; i < clean.size(); ++i) {
    if (bad[i] == clean[i]) continue;
    ++spurious;
    least_m = std::min(least_m, bad[i]);
    most_m = std::max(most_m, bad[i]);
  }
  EXPECT_NEAR(spurious, 180, 40);  // 3 standard deviations
  EXPECT_GE(least_m, 0.02F);
  EXPECT_LT(least_m, 3.0F);
  EXPECT_LE(most_m, 32.0F);
  EXPECT_GT(most_m, 29.0F);
}

}  // namespace
}  // namespace homeward::sim::laser_test
