// SPDX-License-Identifier: Apache-2.0
#include "scenario/simulated_robot.hpp"

#include <gtest/gtest.h>

#include <random>

#include "sim/generate/builder.hpp"
#include "sim/laser.hpp"
#include "sim/scene_rays.hpp"

namespace homeward::scenario::simulated_robot_test {
namespace {

TEST(SafetyScanner, SeesATableTopAtAnyHeightThatABodyCanTouch) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> height_m(0.1, 1.384);
  sim::LaserConfig scanner = safety_scanner();
  scanner.noise_m = 1e-6;
  scanner.rays = 1;
  for (int i = 0; i < 200; ++i) {
    const double bottom_m = height_m(random);
    sim::SceneBuilder builder;
    const sim::Surface grey{builder.add_material("grey", std::array{0.5F, 0.5F, 0.5F}), 0.0};
    builder.box({}, {1.0, -1.0, bottom_m}, {1.8, 1.0, bottom_m + 0.016}, {grey, grey});
    builder.box({}, {2.0, -1.0, 0.0}, {2.2, 1.0, 2.0}, {grey, grey});
    EXPECT_NEAR(sim::scan(sim::rays_of(builder.take()), {}, {}, scanner, 1)[0], 1.0, 1e-4) << bottom_m;
  }
}

TEST(SafetyRing, HearsAsHighUpAsTheScannerSees) { EXPECT_EQ(safety_ring().heights_m, safety_scanner().heights_m); }

}  // namespace
}  // namespace homeward::scenario::simulated_robot_test
