// SPDX-License-Identifier: Apache-2.0
#include "agent/drivers/range_ring.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/sample_rosbridge.hpp"

namespace homeward::agent::range_ring_test {
namespace {

using homeward::testing::sample_ring;

constexpr float kNothing = std::numeric_limits<float>::infinity();

RosRange says(std::size_t sensor, float range_m) { return {std::nullopt, sensor, range_m, 0.2F}; }

/// All sensors say the same.
void all_say(RangeRing& ring, std::size_t sensors, float range_m, driving::Milliseconds now, const Pose2& odometry) {
  for (std::size_t i = 0; i < sensors; ++i) ring.add(says(i, range_m), now, odometry);
}

double nearest_m(const driving::Scan& scan, double direction_rad, double within_rad) {
  double nearest = 1e9;
  for (const Eigen::Vector2d& at_m : driving::hit_points(scan)) {
    if (std::abs(wrap_angle(std::atan2(at_m.y(), at_m.x()) - direction_rad)) > within_rad) continue;
    nearest = std::min(nearest, at_m.norm());
  }
  return nearest;
}

TEST(RangeRing, MakesASweepOnceEverySensorHasSpoken) {
  RangeRing ring(sample_ring(9));
  for (std::size_t i = 0; i < 8; ++i) {
    ring.add(says(i, i == 0 ? 1.0F : kNothing), 1000 + static_cast<driving::Milliseconds>(10 * i), {});
    EXPECT_FALSE(ring.sweep(1100, {})) << i;
  }
  ring.add(says(8, kNothing), 1090, {});
  const auto sweep = ring.sweep(1100, {});
  ASSERT_TRUE(sweep);
  EXPECT_EQ(sweep->taken_ms, 1000) << "as old as the oldest of its readings";
  EXPECT_NEAR(nearest_m(sweep->scan, 0.0, 0.1), 1.3, 0.05);  // from the turning point
  EXPECT_GT(nearest_m(sweep->scan, kPi, 1.0), 1e6);
  EXPECT_TRUE(driving::looks_behind(sweep->scan));
  EXPECT_FALSE(ring.sweep(1110, {})) << "each word counts once";
}

TEST(RangeRing, WithOneSensorSilentThereIsNoSweep) {
  RangeRing ring(sample_ring(9));
  all_say(ring, 9, 2.0F, 1000, {});
  EXPECT_TRUE(ring.sweep(1000, {}));
  for (driving::Milliseconds now = 1100; now < 4000; now += 100) {
    all_say(ring, 8, 2.0F, now, {});  // the ninth is dead
    EXPECT_FALSE(ring.sweep(now, {})) << now;
  }
  ring.add(says(8, 2.0F), 4000, {});
  EXPECT_TRUE(ring.sweep(4000, {}));
}

TEST(RangeRing, WhatWasSaidTooLongAgoDoesNotCount) {
  RangeRing ring(sample_ring(9));
  ring.add(says(0, 2.0F), 1000, {});
  for (std::size_t i = 1; i < 9; ++i) ring.add(says(i, 2.0F), 1500, {});
  EXPECT_FALSE(ring.sweep(1500, {}));
  ring.add(says(0, 2.0F), 1510, {});
  EXPECT_TRUE(ring.sweep(1510, {}));
  all_say(ring, 9, 2.0F, 1600, {});
  ring.forget();
  EXPECT_FALSE(ring.sweep(1600, {}));
}

TEST(RangeRing, PlacesReadingsWhereTheRobotWas) {
  RangeRing ring(sample_ring(9));
  all_say(ring, 9, kNothing, 1000, {});
  ring.add(says(0, 1.0F), 1000, {});
  const auto sweep = ring.sweep(1100, {0.1, 0.0, 0.0});  // it has driven on by 0.1 m
  ASSERT_TRUE(sweep);
  EXPECT_NEAR(nearest_m(sweep->scan, 0.0, 0.1), 1.2, 0.05);
}

TEST(RangeRing, LooksBehindOnlyWhereItHearsAllOfThat) {
  // Five sensors: from 20 degrees to the right of ahead over the left to straight back, and nothing on the other side.
  RangeRing front(sample_ring(5));
  EXPECT_GT(front.uncovered_deg(), 120);
  all_say(front, 5, 1.0F, 1000, {});
  const auto sweep = front.sweep(1000, {});
  ASSERT_TRUE(sweep);
  EXPECT_FALSE(driving::looks_behind(sweep->scan));
  EXPECT_NEAR(nearest_m(sweep->scan, 0.0, 0.1), 1.3, 0.05);
  EXPECT_NEAR(nearest_m(sweep->scan, radians(80.0), 0.1), 1.3, 0.05);
  EXPECT_EQ(RangeRing(sample_ring(9)).uncovered_deg(), 0);
  EXPECT_TRUE(RangeRing(sample_ring(9)).covers_ahead());
  EXPECT_FALSE(front.covers_ahead()) << "not 30 degrees to both sides";
}

TEST(RangeRing, BesideAScannerTheNearestOfBothCounts) {
  RangeRing ring(sample_ring(9));
  all_say(ring, 9, kNothing, 1000, {});
  ring.add(says(0, 0.7F), 1000, {});
  const auto heard = ring.sweep(1000, {});
  ASSERT_TRUE(heard);
  driving::Scan scan;  // 180 degrees ahead, everything 5 m off
  scan.ranges_m.assign(181, 5.0F);
  scan.angle_min_rad = -0.5 * kPi;
  scan.angle_step_rad = radians(1.0);
  scan.robot_from_scan = {0.2, 0.0, 0.0};
  const driving::Scan both = with_ring(scan, *heard, {0.1, 0.0, 0.0});
  EXPECT_NEAR(nearest_m(both, 0.0, 0.1), 0.9, 0.05);  // 0.3 + 0.7, and driven 0.1 m since
  EXPECT_NEAR(nearest_m(both, radians(60.0), 0.1), std::hypot(0.2 + 5.0 * 0.5, 5.0 * 0.866), 0.15);
  EXPECT_GT(nearest_m(both, kPi, 1.0), 1e6);
  EXPECT_TRUE(driving::looks_behind(both)) << "as the ring does";
  RangeRing few(sample_ring(1));
  few.add(says(0, 0.7F), 1000, {});
  EXPECT_FALSE(driving::looks_behind(with_ring(scan, *few.sweep(1000, {}), {})));
}

}  // namespace
}  // namespace homeward::agent::range_ring_test
