// SPDX-License-Identifier: Apache-2.0
#include "geometry/repetition.hpp"

#include <gtest/gtest.h>

#include "support/planar_scene.hpp"

namespace homeward::geometry::repetition_test {
namespace {

using homeward::testing::direction_error_deg;
using homeward::testing::planar_scene;
using homeward::testing::PlanarScene;

std::vector<Correspondence> together(const PlanarScene& a, const PlanarScene& b) {
  std::vector<Correspondence> both = a.correspondences;
  both.insert(both.end(), b.correspondences.begin(), b.correspondences.end());
  return both;
}

SharedView seen_from(double step_m, double outlier_share, std::uint64_t seed) {
  const PlanarScene scene = planar_scene(200, outlier_share, 0.0, step_m, seed);
  return shared_view(scene.correspondences, fit_motion(MatchRows(scene.correspondences), {scene.truth}, {}));
}

TEST(SharedView, CountsHeightsInStepsAndTheShareThatAgrees) {
  // Heights of the room are even between -1.2 m and 1.3 m: the median is 0.62 m from the camera's. What parallax may be
  // off by makes it less, the more so the smaller the step.
  for (const double step_m : {0.4, 0.8, 1.6}) {
    const double height = seen_from(step_m, 0.0, 3).height;
    EXPECT_LT(height, 1.1 * 0.62 / step_m) << step_m;
    EXPECT_GT(height, 0.65 * 0.62 / step_m) << step_m;
  }
  EXPECT_GT(seen_from(0.8, 0.0, 4).agreeing, 0.95);
  EXPECT_NEAR(seen_from(0.8, 0.5, 5).agreeing, 0.52, 0.08);
  EXPECT_EQ(shared_view({}, MotionFit{}).agreeing, 0.0);
}

TEST(Repetition, IsWhatSeemsNearAndSharesLittle) {
  EXPECT_LT(repetition_probability({0.5, 0.2}), 0.1);    // far apart: few matches are to be expected
  EXPECT_LT(repetition_probability({4.0, 0.7}), 0.02);   // near, and nearly everything is there
  EXPECT_GT(repetition_probability({4.0, 0.25}), 0.8);   // near, and most of it is missing
  EXPECT_LT(repetition_probability({100.0, 0.7}), 0.1);  // the same spot, by night
  EXPECT_LT(repetition_probability({0.0, 0.0}), 0.1);
  for (double height = 0.2; height < 20.0; height *= 2.0) {
    EXPECT_LE(repetition_probability({height, 0.3}), repetition_probability({2.0 * height, 0.3}));
    EXPECT_GE(repetition_probability({height, 0.3}), repetition_probability({height, 0.4}));
  }
}

TEST(Repetition, GivesWayToAMotionThatFewerMatchesAgreeWith) {
  // A bay of the corridor stands where the last one stood, 10 cm off: 60 matches against 50 of the real step of 2 m.
  int with = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const PlanarScene far_step = planar_scene(120, 70.0 / 120.0, 0.001, 2.0, 100 + seed);
    const PlanarScene bay = planar_scene(60, 0.0, 0.001, 0.1, 200 + seed);
    const auto estimate = estimate_planar_motion(together(bay, far_step), {}, seed);
    with += estimate && direction_error_deg(estimate->motion, far_step.truth) < 5.0 ? 1 : 0;
  }
  EXPECT_GE(with, 13);
}

TEST(Repetition, AloneIsLittleEvidence) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const PlanarScene bay = planar_scene(150, 0.75, 0.001, 0.1, 300 + seed);
    const auto repeated = estimate_planar_motion(bay.correspondences, {}, seed);
    const PlanarScene room = planar_scene(150, 0.1, 0.001, 0.1, 300 + seed);
    const auto shared = estimate_planar_motion(room.correspondences, {}, seed);
    ASSERT_TRUE(shared);
    EXPECT_GT(shared->evidence, 100.0) << seed;
    EXPECT_LT(direction_error_deg(shared->motion, room.truth), 10.0) << seed;
    if (repeated) {
      EXPECT_LT(repeated->evidence, 20.0) << seed;
    }
  }
}

}  // namespace
}  // namespace homeward::geometry::repetition_test
