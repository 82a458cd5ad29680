// SPDX-License-Identifier: Apache-2.0
#include "geometry/tilted_motion.hpp"

#include <gtest/gtest.h>

#include "core/angles.hpp"
#include "geometry/planar_solver.hpp"
#include "geometry/tilted_refinement.hpp"
#include "support/planar_scene.hpp"

namespace homeward::geometry::tilted_motion_test {
namespace {

using homeward::testing::planar_scene;
using homeward::testing::PlanarScene;

/// The same scene with the target camera tilted.
PlanarScene tilted_scene(int count, double outlier_share, double noise_rad, double roll_rad, double pitch_rad,
                         std::uint64_t seed) {
  PlanarScene scene = planar_scene(count, outlier_share, noise_rad, 0.8, seed);
  const TiltedMotion tilt{{0.0, 0.0}, 0.0, roll_rad, pitch_rad};
  for (Correspondence& c : scene.correspondences) c.target = tilt.rotation().transpose() * c.target;
  return scene;
}

TEST(EpipolarError, OfALevelMotionIsThePlanarOne) {
  const PlanarScene scene = planar_scene(50, 0.5, 0.01, 0.8, 4);
  const EpipolarError error({scene.truth});
  for (const Correspondence& c : scene.correspondences) {
    EXPECT_NEAR(std::abs(error(c)), epipolar_error_rad(scene.truth, c), 1e-12);
  }
}

TEST(EpipolarError, IsZeroForTheTiltedTruth) {
  const PlanarScene scene = tilted_scene(50, 0.0, 0.0, 0.04, -0.03, 5);
  const EpipolarError error({scene.truth, 0.0, 0.04, -0.03});
  for (const Correspondence& c : scene.correspondences) EXPECT_NEAR(error(c), 0.0, 1e-9);
}

TEST(RefineTilted, FindsDirectionTurnAndTilt) {
  const PlanarScene scene = tilted_scene(80, 0.0, 0.0, 0.03, -0.02, 6);
  TiltedMotion motion{{scene.truth.direction_rad + 0.1, scene.truth.turn_rad - 0.05}};
  const MatchRows matches(scene.correspondences);
  for (int step = 0; step < 20; ++step) refine_tilted(matches, 1.0, 0.05, {1.0, 1.0}, motion);
  EXPECT_NEAR(wrap_angle(motion.planar.direction_rad - scene.truth.direction_rad), 0.0, 1e-4);
  EXPECT_NEAR(wrap_angle(motion.planar.turn_rad - scene.truth.turn_rad), 0.0, 1e-4);
  EXPECT_NEAR(motion.roll_rad, 0.03, 1e-4);
  EXPECT_NEAR(motion.pitch_rad, -0.02, 1e-4);
}

TEST(RefineTilted, WithoutMatchesThePriorHoldsTheTilt) {
  TiltedMotion motion{{0.5, 0.2}, 0.01, 0.02, -0.02};
  for (int step = 0; step < 5; ++step) refine_tilted(MatchRows({}), 1.0, 0.003, {}, motion);
  EXPECT_NEAR(motion.elevation_rad, 0.0, 1e-3);
  EXPECT_NEAR(motion.roll_rad, 0.0, 1e-3);
  EXPECT_NEAR(motion.planar.direction_rad, 0.5, 1e-9);
}

TEST(PlanarEstimate, ACameraThatIsTiltedByADegreeMostlyKeepsItsDirectionAndItsMatches) {
  int right_directions = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const PlanarScene scene = tilted_scene(120, 0.4, 0.001, radians(1.0), radians(-0.7), 300 + seed);
    const auto estimate = estimate_planar_motion(scene.correspondences, {}, seed);
    ASSERT_TRUE(estimate) << seed;
    const double error_rad = wrap_angle(estimate->motion.direction_rad - scene.truth.direction_rad);
    int right = 0;
    for (const int inlier : estimate->inliers) right += scene.outlier[static_cast<std::size_t>(inlier)] ? 0 : 1;
    if (std::abs(error_rad) < radians(6.0) && right > 0.9 * 0.6 * 120) ++right_directions;
  }
  EXPECT_GE(right_directions, 18);
}

}  // namespace
}  // namespace homeward::geometry::tilted_motion_test
