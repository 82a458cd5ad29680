// SPDX-License-Identifier: Apache-2.0
#include "geometry/general_motion.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support/planar_scene.hpp"

namespace homeward::geometry::general_motion_test {
namespace {

using homeward::testing::planar_scene;
using homeward::testing::PlanarScene;

/// The scene with the target camera tilted about a level axis.
PlanarScene tilted(PlanarScene scene, double tilt_rad, double axis_rad) {
  const Eigen::AngleAxisd tilt(tilt_rad, Eigen::Vector3d(std::cos(axis_rad), std::sin(axis_rad), 0.0));
  for (Correspondence& c : scene.correspondences) c.target = tilt * c.target;
  return scene;
}

double off_deg(double a_rad, double b_rad) { return std::abs(degrees(wrap_angle(a_rad - b_rad))); }

TEST(GeneralMotion, AnswersWhereTheViewIsTiltedAndThePlanarMotionFails) {
  int planar_right = 0;
  int scenes = 0;
  for (const double tilt_deg : {15.0, 20.0, 25.0, 30.0}) {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      const PlanarScene scene = tilted(planar_scene(120, 0.3, 0.001, 0.8, 70 + seed), radians(tilt_deg), 0.7 * seed);
      const auto general = estimate_motion(scene.correspondences, {}, seed);
      ASSERT_TRUE(general) << tilt_deg << " " << seed;
      EXPECT_TRUE(general->general) << tilt_deg << " " << seed;
      EXPECT_LT(off_deg(general->motion.direction_rad, scene.truth.direction_rad), 5.0) << tilt_deg << " " << seed;
      EXPECT_NEAR(degrees(general->tilt_rad), tilt_deg, 1.0) << seed;
      EXPECT_GT(general->inliers.size(), 70U);
      const auto planar = estimate_planar_motion(scene.correspondences, {}, seed);
      planar_right += planar && planar->inliers.size() > 40 &&
                      off_deg(planar->motion.direction_rad, scene.truth.direction_rad) < 5.0;
      ++scenes;
    }
  }
  EXPECT_LT(planar_right, scenes / 4);
}

TEST(GeneralMotion, OnTheFloorThePlanarMotionWins) {
  for (const double outliers : {0.0, 0.5, 0.7}) {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      const PlanarScene scene = planar_scene(120, outliers, 0.001, 0.8, 170 + seed);
      const auto estimate = estimate_motion(scene.correspondences, {}, seed);
      ASSERT_TRUE(estimate);
      EXPECT_FALSE(estimate->general) << outliers << " " << seed;
      EXPECT_LT(off_deg(estimate->motion.direction_rad, scene.truth.direction_rad), 3.0) << outliers << " " << seed;
    }
  }
}

TEST(GeneralMotion, MatchesAtRandomAreNoGeneralMotion) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const PlanarScene scene = planar_scene(60, 1.0, 0.001, 0.8, 270 + seed);
    const auto estimate = estimate_motion(scene.correspondences, {}, seed);
    if (estimate) {
      EXPECT_FALSE(estimate->general) << seed;
    }
  }
}

TEST(GeneralMotion, IsTheSameForTheSameSeed) {
  const PlanarScene scene = tilted(planar_scene(90, 0.4, 0.001, 0.8, 7), radians(20.0), 0.3);
  const auto once = estimate_motion(scene.correspondences, {}, 5);
  const auto twice = estimate_motion(scene.correspondences, {}, 5);
  ASSERT_TRUE(once && twice);
  EXPECT_EQ(once->motion.direction_rad, twice->motion.direction_rad);
  EXPECT_EQ(once->inliers, twice->inliers);
}

}  // namespace
}  // namespace homeward::geometry::general_motion_test
