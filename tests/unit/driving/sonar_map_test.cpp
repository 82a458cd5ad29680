// SPDX-License-Identifier: Apache-2.0
#include "driving/sonar_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/angles.hpp"

namespace homeward::driving::sonar_map_test {
namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();

double nearest_m(const Scan& scan, double from_rad, double to_rad) {
  double nearest = 1e9;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const double angle_rad = wrap_angle(scan.angle_min_rad + static_cast<double>(i) * scan.angle_step_rad);
    if (angle_rad >= from_rad && angle_rad <= to_rad) nearest = std::min(nearest, double{scan.ranges_m[i]});
  }
  return nearest;
}

TEST(SonarMap, TakesAllOfAnArcNearbyForThings) {
  SonarMap map;
  const Scan scan = map.update({{{0.15, 0.0, 0.0}, 0.55F}}, {});
  for (const double angle_rad : {-0.2, -0.1, 0.0, 0.1, 0.2}) {
    const double there_m = nearest_m(scan, angle_rad - 0.02, angle_rad + 0.02);
    EXPECT_GT(there_m, 0.66) << angle_rad;
    EXPECT_LT(there_m, 0.71) << angle_rad;
  }
  EXPECT_GT(nearest_m(scan, 0.4, kPi), 100.0);
  EXPECT_GT(nearest_m(scan, -kPi, -0.4), 100.0);
}

TEST(SonarMap, ASensorMayHaveAConeOfItsOwn) {
  SonarMap map;
  const SonarCone narrow{0.1, 0.2, 1.0};
  const Scan scan = map.update({{{0.15, 0.0, 0.0}, 0.55F, narrow}}, {});
  EXPECT_LT(nearest_m(scan, -0.02, 0.02), 0.71);
  EXPECT_GT(nearest_m(scan, 0.12, kPi), 100.0);
  const Scan beyond = SonarMap().update({{{0.15, 0.0, 0.0}, 1.2F, narrow}}, {});
  EXPECT_TRUE(hit_points(beyond).empty()) << "farther than it measures";
}

TEST(SonarMap, TakesOnlyTheMiddleOfAnArcFarAway) {
  SonarMap map;
  const Scan scan = map.update({{{0.15, 0.0, 0.0}, 2.0F}}, {});
  EXPECT_NEAR(nearest_m(scan, -0.05, 0.05), 2.15, 0.01);
  EXPECT_GT(nearest_m(scan, 0.12, kPi), 100.0);
}

TEST(SonarMap, KeepsADoorOpenThatItHasSeenThrough) {
  SonarMap map;
  map.update({{{0.0, 0.0, 0.0}, 2.5F}}, {});
  // Turned a little, the same cone meets a post on its left; ahead it is as free as before.
  const Scan scan = map.update({{{0.0, 0.0, 0.2}, 1.0F}}, {});
  EXPECT_GT(nearest_m(scan, -0.1, 0.22), 2.0);
  EXPECT_LT(nearest_m(scan, 0.26, 0.4), 1.1);
  // Somebody who steps into the middle of it is no post.
  const Scan person = map.update({{{0.0, 0.0, 0.0}, 1.0F}}, {});
  EXPECT_LT(nearest_m(person, -0.1, 0.1), 1.1);
}

TEST(SonarMap, FreesWhatAnotherConeSeesThrough) {
  SonarMap map;
  // The thing is on the left of the first cone: the second, turned to the right, looks past it.
  const Scan scan = map.update({{{0.0, 0.0, 0.0}, 0.55F}, {{0.0, 0.0, -0.3927}, 2.5F}}, {});
  EXPECT_LT(nearest_m(scan, 0.0, 0.25), 0.6);
  EXPECT_GT(nearest_m(scan, -0.25, -0.16), 2.0);
}

TEST(SonarMap, RemembersWhileTheRobotMovesOn) {
  SonarMap map;
  map.update({{{0.0, 0.0, kPi / 2.0}, 0.6F}}, {1.0, 2.0, 0.5});
  const Pose2 later = Pose2{1.0, 2.0, 0.5} * Pose2{0.4, 0.0, 0.0};
  const Scan scan = map.update({{{0.0, 0.0, kPi / 2.0}, kNothing}}, later);
  // 0.6 m to the left of where it was is 0.4 m behind that of where it is, outside of the cone there.
  EXPECT_NEAR(nearest_m(scan, 2.0, 2.6), std::hypot(0.4 - 0.155, 0.58), 0.03);
}

TEST(SonarMap, ForgetsWhatIsSeenToBeFree) {
  SonarMap map;
  map.update({{{0.0, 0.0, 0.0}, 1.0F}}, {});
  const Scan scan = map.update({{{0.0, 0.0, 0.0}, kNothing}}, {});
  EXPECT_GT(nearest_m(scan, -0.2, 0.2), 100.0);
}

TEST(SonarMap, KeepsItsNoseBeforeWhatIsTooNearToMeasure) {
  SonarMap map;
  map.update({{{0.15, 0.0, 0.0}, 0.3F}}, {});
  const Scan scan = map.update({{{0.15, 0.0, 0.0}, 0.2F}}, {});  // whatever that is, it frees nothing
  EXPECT_NEAR(nearest_m(scan, -0.1, 0.1), 0.35, 1e-3);
}

}  // namespace
}  // namespace homeward::driving::sonar_map_test
