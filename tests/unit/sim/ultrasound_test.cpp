// SPDX-License-Identifier: Apache-2.0
#include "sim/ultrasound.hpp"

#include <gtest/gtest.h>

#include "core/angles.hpp"
#include "sim/motion.hpp"
#include "sim/renderer.hpp"
#include "support/box_world.hpp"

namespace homeward::sim::ultrasound_test {
namespace {

UltrasoundConfig quiet() {
  UltrasoundConfig config;
  config.heights_m = {0.3, 0.9};
  config.noise_m = 0.0;
  return config;
}

TEST(UltrasoundRing, SitsAsFarInsideTheOutlineAsItIsBlind) {
  for (const RobotProfile& profile : {disc_profile(), chair_profile()}) {
    const UltrasoundConfig config = quiet();
    const std::vector<Pose2> ring = ultrasound_ring(profile.outline, config);
    ASSERT_EQ(ring.size(), 16U);
    for (const Pose2& sensor : ring) {
      const Pose2 reached = sensor * Pose2{config.range_min_m, 0.0, 0.0};
      EXPECT_NEAR(distance_m(profile.outline, {reached.x_m, reached.y_m}), 0.0, 1e-6) << profile.name;
    }
  }
}

TEST(Ultrasound, HearsTheNearestInItsCone) {
  LitWorld lit(homeward::testing::box_world());
  const UltrasoundConfig config = quiet();
  const std::vector<Pose2> ring = ultrasound_ring(disc_profile().outline, config);
  const std::vector<float> ranges_m = ultrasound(lit.rays(), {0.0, 0.0, 0.0}, ring, {}, config, 1);
  ASSERT_EQ(ranges_m.size(), 16U);
  EXPECT_NEAR(ranges_m[0], 2.0 - 0.15, 1e-3);
  EXPECT_NEAR(ranges_m[4], 1.5 - 0.15, 1e-3);
  // 22.5 degrees off the wall ahead: not along its middle, but at the edge of the cone that is nearest to the wall.
  const double edge_rad = kPi / 8.0 - 0.5 * config.cone_rad;
  EXPECT_NEAR(ranges_m[1], (2.0 - 0.15 * std::cos(kPi / 8.0)) / std::cos(edge_rad), 1e-3);
}

TEST(Ultrasound, HearsPeopleAndNothingBeyondItsReach) {
  LitWorld lit(homeward::testing::box_world());
  UltrasoundConfig config = quiet();
  config.range_max_m = 1.0;
  const std::vector<Pose2> ring = ultrasound_ring(disc_profile().outline, config);
  const std::vector<Person> people = {{-0.8, 0.0, 7}};
  const std::vector<float> ranges_m = ultrasound(lit.rays(), {0.0, 0.0, 0.0}, ring, people, config, 1);
  EXPECT_TRUE(std::isinf(ranges_m[0]));
  EXPECT_LT(ranges_m[8], 0.65F);
  const std::vector<Person> touching = {{-0.4, 0.0, 7}};  // nearer than it can measure
  EXPECT_EQ(ultrasound(lit.rays(), {0.0, 0.0, 0.0}, ring, touching, config, 1)[8], 0.2F);
}

}  // namespace
}  // namespace homeward::sim::ultrasound_test
