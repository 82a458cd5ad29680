// SPDX-License-Identifier: Apache-2.0
#include "unit/agent/rosbridge_fixture.hpp"

namespace homeward::agent::rosbridge_ranges_test {
namespace {

constexpr int kSensors = 9;

wire::RosbridgeFile ring_robot(bool with_scan) {
  wire::RosbridgeFile robot = sample_rosbridge();
  if (!with_scan) robot.scan.reset();
  robot.ranges = sample_ring(kSensors);
  return robot;
}

/// A robot with a ring of ultrasound sensors, with or without a scanner.
class RosbridgeRing : public RosbridgeDriverTest {
 protected:
  explicit RosbridgeRing(bool with_scan = false) : RosbridgeDriverTest(ring_robot(with_scan)) {}

  /// Odometry and the words of all sensors but `silent`, as a live robot sends them.
  void sense_ring(int silent = -1) {
    const std::int64_t now_us = stamp_us();
    bridge_->publish("/odom", odometry_message(now_us, {}, 0.2));
    for (int i = 0; i < kSensors; ++i) {
      if (i != silent) bridge_->publish("/sonar/" + std::to_string(i), range_message(now_us, i == 0 ? 1.0 : 4.0));
    }
  }
  std::optional<driving::Scan> ring_sweep(std::chrono::milliseconds within, int silent = -1) {
    const auto end = Clock::now() + within;
    while (Clock::now() < end) {
      sense_ring(silent);
      std::this_thread::sleep_for(50ms);
      driver_->command({});
      if (auto scan = driver_->read().scan) return scan;
    }
    return std::nullopt;
  }
};

class RosbridgeRingBesideAScan : public RosbridgeRing {
 protected:
  RosbridgeRingBesideAScan() : RosbridgeRing(true) {}
};

TEST_F(RosbridgeRing, IsASweepLikeAScanners) {
  const auto scan = ring_sweep(4s);
  ASSERT_TRUE(scan);
  const auto points_m = driving::hit_points(*scan);
  ASSERT_FALSE(points_m.empty());
  for (const Eigen::Vector2d& at_m : points_m) {
    EXPECT_LT(std::abs(std::atan2(at_m.y(), at_m.x())), 0.4);
    EXPECT_NEAR(at_m.norm(), 1.3, 0.1);
  }
  EXPECT_TRUE(driving::looks_behind(*scan));
  EXPECT_TRUE(driver_->body().vague_ranges);
}

TEST_F(RosbridgeRing, MustHearAhead) {
  wire::RosbridgeFile robot = ring_robot(false);
  robot.ranges.erase(robot.ranges.begin());  // the one that looks ahead
  folder_.put("deaf.json", wire::rosbridge_to_json(robot).dump());
  const auto refused = make_rosbridge_driver((folder_.path() / "deaf.json").string(), [](const std::string&) {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidInput);
  EXPECT_NE(refused.error().where.find("ranges"), std::string::npos);
}

TEST_F(RosbridgeRing, SaysNothingWhileOneOfItIsSilent) {
  ASSERT_TRUE(ring_sweep(4s));
  std::this_thread::sleep_for(500ms);  // what is on its way arrives, and grows too old
  driver_->read();
  EXPECT_FALSE(ring_sweep(1500ms, 3)) << "the robot stops: no sweep is fresh";
  EXPECT_TRUE(ring_sweep(4s));
}

TEST_F(RosbridgeRing, ARepeatedWordIsNoNewOne) {
  ASSERT_TRUE(ring_sweep(4s));
  std::this_thread::sleep_for(500ms);
  driver_->read();
  const std::int64_t repeated_us = stamp_us();
  for (int i = 0; i < 10; ++i) {
    bridge_->publish("/odom", odometry_message(stamp_us(), {}, 0.2));
    for (int k = 0; k < kSensors; ++k) bridge_->publish("/sonar/" + std::to_string(k), range_message(repeated_us, 1.0));
    std::this_thread::sleep_for(50ms);
    if (i >= 3) {
      EXPECT_FALSE(driver_->read().scan) << i;
    } else {
      driver_->read();
    }
  }
}

TEST_F(RosbridgeRingBesideAScan, AScannerAloneSaysNothingAndBothTogetherDo) {
  EXPECT_FALSE(sweeps_come(600ms)) << "odometry and scans, but no ring";
  bool came = false;
  for (int i = 0; i < 60 && !came; ++i) {
    sense_ring();
    bridge_->publish("/scan", sweep_message(stamp_us(), {2.0, 2.0, 2.0, 2.0}));
    std::this_thread::sleep_for(50ms);
    driver_->command({});
    const auto scan = driver_->read().scan;
    if (!scan) continue;
    came = true;
    double nearest_m = 1e9;
    double farthest_m = 0.0;
    for (const Eigen::Vector2d& at_m : driving::hit_points(*scan)) {
      nearest_m = std::min(nearest_m, at_m.norm());
      farthest_m = std::max(farthest_m, at_m.norm());
    }
    EXPECT_NEAR(nearest_m, 1.3, 0.1) << "of the ring";
    EXPECT_NEAR(farthest_m, 2.0, 0.15) << "of the scanner";
  }
  EXPECT_TRUE(came);
}

}  // namespace
}  // namespace homeward::agent::rosbridge_ranges_test
