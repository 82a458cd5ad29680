// SPDX-License-Identifier: Apache-2.0
#include "sim/floor_plan.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/angles.hpp"
#include "sim/generate/builder.hpp"

namespace homeward::sim::floor_plan_test {
namespace {

constexpr double kFar_m = 5.0;
constexpr Outline kDisc{0.35, 0.0, 0.0, 0.0};
constexpr Outline kRectangle{0.0, 0.25, 0.85, 0.325};

/// Quads between their corners, nothing else.
Scene quads(const std::vector<std::array<Eigen::Vector3d, 4>>& corners) {
  SceneBuilder builder;
  const Surface surface{builder.add_material("grey", std::array<float, 3>{0.5F, 0.5F, 0.5F}), 0.0};
  for (const auto& quad : corners) builder.quad({}, quad, surface);
  return builder.take();
}

std::array<Eigen::Vector3d, 4> wall(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m) {
  return {{{from_m.x(), from_m.y(), 2.5},
           {to_m.x(), to_m.y(), 2.5},
           {to_m.x(), to_m.y(), 0.0},
           {from_m.x(), from_m.y(), 0.0}}};
}

TEST(FloorPlan, MeasuresWallsToTheMillimetreWhateverTheirDirection) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> across_m(-3.0, 3.0);
  for (int k = 0; k < 100; ++k) {
    const Eigen::Vector2d from_m(across_m(random), across_m(random));
    const Eigen::Vector2d to_m(across_m(random), across_m(random));
    const FloorPlan plan(quads({wall(from_m, to_m)}));
    const Pose2 pose{across_m(random), across_m(random), across_m(random)};
    for (const Outline& outline : {kDisc, kRectangle}) {
      double nearest_m = kFar_m;
      const int steps = static_cast<int>((to_m - from_m).norm() / 0.0005) + 1;
      for (int i = 0; i <= steps; ++i) {
        const Eigen::Vector2d at_m = from_m + (to_m - from_m) * i / steps;
        const Pose2 seen = inverse(pose) * Pose2{at_m.x(), at_m.y(), 0.0};
        nearest_m = std::min(nearest_m, distance_m(outline, {seen.x_m, seen.y_m}));
      }
      EXPECT_NEAR(plan.clearance_m(outline, pose, kFar_m), nearest_m, 0.0005) << k;
    }
  }
}

TEST(FloorPlan, MeasuresARobotThatStandsThereByItsOwnOutline) {
  FloorPlan plan{Scene()};
  plan.add(Box{{1.0, 0.0, 0.7}, kDisc, 0.9});
  EXPECT_NEAR(plan.clearance_m(kDisc, {0.18, 0.0, 0.0}, kFar_m), 0.12, 0.001) << "a square about it would be touched";
  plan.add(Box{{-2.0, 0.0, kPi}, kRectangle, 0.9});
  EXPECT_NEAR(plan.clearance_m(kDisc, {-1.0, 0.0, 0.0}, kFar_m), 0.4, 0.001) << "its back is here";
  EXPECT_NEAR(plan.clearance_m(kDisc, {-3.5, 0.0, 0.0}, kFar_m), 0.3, 0.001) << "its front is here";
}

TEST(FloorPlan, SaysNoMoreThanHowFarItWasToLook) {
  const FloorPlan plan(quads({wall({2.0, -3.0}, {2.0, 3.0})}));
  EXPECT_NEAR(plan.clearance_m(kDisc, {0.0, 0.0, 0.0}, kFar_m), 1.65, 1e-6);
  EXPECT_NEAR(plan.clearance_m(kDisc, {0.0, 0.0, 0.0}, 1.7), 1.65, 1e-6);
  EXPECT_EQ(plan.clearance_m(kDisc, {0.0, 0.0, 0.0}, 1.6), 1.6);
  EXPECT_NEAR(plan.clearance_m(kDisc, {1.9, 0.0, 0.0}, -0.2), -0.25, 1e-6) << "and deeper in the wall than that";
  EXPECT_EQ(FloorPlan(Scene()).clearance_m(kDisc, {}, kFar_m), kFar_m);
}

TEST(FloorPlan, CountsOfASlopeWhatIsBetweenTheHeights) {
  // From the floor at x = 0 up to 2.8 m at x = 2.8.
  const Scene slope = quads({{{{2.8, 1.0, 2.8}, {2.8, -1.0, 2.8}, {0.0, -1.0, 0.0}, {0.0, 1.0, 0.0}}}});
  const FloorPlan plan(slope, 0.1, 1.4);
  EXPECT_NEAR(plan.clearance_m(kDisc, {-1.0, 0.0, 0.0}, kFar_m), 1.1 - 0.35, 1e-5);
  EXPECT_NEAR(plan.clearance_m(kDisc, {3.0, 0.0, 0.0}, kFar_m), 1.6 - 0.35, 1e-5);
}

TEST(FloorPlan, LeavesOutWhatIsOverheadOrCanBeDrivenOver) {
  const auto level = [](double up_m) {
    return std::array<Eigen::Vector3d, 4>{{{0.0, 1.0, up_m}, {1.0, 1.0, up_m}, {1.0, 0.0, up_m}, {0.0, 0.0, up_m}}};
  };
  EXPECT_EQ(FloorPlan(quads({level(0.05), level(1.5)})).clearance_m(kDisc, {0.5, -0.5, 0.0}, kFar_m), kFar_m);
  EXPECT_NEAR(FloorPlan(quads({level(0.75)})).clearance_m(kDisc, {0.5, -0.5, 0.0}, kFar_m), 0.15, 1e-6);
}

TEST(FloorPlan, HoldsBoxesInsideAndOutsideItsWalls) {
  FloorPlan plan(quads({wall({-1.0, 2.0}, {1.0, 2.0})}));
  plan.add(Box{{0.0, 0.0, 0.25 * kPi}});
  plan.add(Box{{6.0, 0.0, 0.0}});
  EXPECT_NEAR(plan.clearance_m(kDisc, {-1.0, 0.0, 0.0}, kFar_m), 1.0 - 0.5 * std::sqrt(0.5) - 0.35, 1e-6);
  EXPECT_NEAR(plan.clearance_m(kRectangle, {4.0, 0.0, 0.0}, kFar_m), 6.0 - 0.25 - 4.85, 1e-6);
}

}  // namespace
}  // namespace homeward::sim::floor_plan_test
