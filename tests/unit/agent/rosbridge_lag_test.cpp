// SPDX-License-Identifier: Apache-2.0
#include "agent/drivers/rosbridge_driver.hpp"

#include "unit/agent/rosbridge_fixture.hpp"

namespace homeward::agent::rosbridge_lag_test {
namespace {

wire::RosbridgeFile ridden(const std::string& twist) {
  wire::RosbridgeFile robot = sample_rosbridge();
  robot.rider = wire::RosRider{{"/joy_vel", twist}, true};
  return robot;
}

/// A rider on a connection that begins to lag.
class LaggingRosbridge : public RosbridgeDriverTest {
 protected:
  explicit LaggingRosbridge(const std::string& twist = "geometry_msgs/msg/Twist")
      : RosbridgeDriverTest(ridden(twist)), stamped_(twist.ends_with("Stamped")) {}

  void push(double speed_mps) {
    const json twist = {{"linear", {{"x", speed_mps}, {"y", 0.0}, {"z", 0.0}}},
                        {"angular", {{"x", 0.0}, {"y", 0.0}, {"z", 0.0}}}};
    bridge_->publish("/joy_vel", stamped_ ? json{{"header", ros_header(stamp_us())}, {"twist", twist}} : twist);
  }
  /// For so long a live robot, whose rider pushes: what the driver says of the hand, 25 times a second.
  std::vector<driving::JoystickReading> ride(double speed_mps, std::chrono::milliseconds duration) {
    std::vector<driving::JoystickReading> hands;
    const auto end = Clock::now() + duration;
    for (int i = 0; Clock::now() < end; ++i) {
      if (i % 2 == 0) sense();
      push(speed_mps);
      std::this_thread::sleep_for(40ms);
      const driving::Reading reading = driver_->read();
      driver_->command({});
      if (reading.rider) hands.push_back(*reading.rider);
    }
    return hands;
  }
  static bool moves(const driving::JoystickReading& hand) { return hand.wanted.speed_mps != 0.0; }
  /// Whether the rider gets through within a while.
  bool rides(double speed_mps) {
    for (int i = 0; i < 20; ++i) {
      const auto hands = ride(speed_mps, 200ms);
      if (std::any_of(hands.begin(), hands.end(), moves)) return true;
    }
    return false;
  }

 private:
  bool stamped_;
};

class LaggingRosbridgeWithStamps : public LaggingRosbridge {
 protected:
  LaggingRosbridgeWithStamps() : LaggingRosbridge("geometry_msgs/msg/TwistStamped") {}
};

TEST_F(LaggingRosbridge, AnOldHandMovesNothing) {
  ASSERT_TRUE(rides(0.25));
  bridge_->delay(800ms);
  ride(0.0, 1000ms);  // whatever was under way, and a break
  const auto hands = ride(0.25, 1200ms);
  EXPECT_TRUE(std::any_of(hands.begin(), hands.end(), [](const auto& hand) { return hand.deflected; }))
      << "it still ends a mission";
  EXPECT_TRUE(std::none_of(hands.begin(), hands.end(), moves));
  EXPECT_TRUE(logged("passed over; the last: "));
}

TEST_F(LaggingRosbridgeWithStamps, AnOldHandMovesNothing) {
  ASSERT_TRUE(rides(0.25));
  bridge_->delay(800ms);
  ride(0.0, 1000ms);
  const auto hands = ride(0.25, 1200ms);
  EXPECT_TRUE(std::none_of(hands.begin(), hands.end(), moves));
}

TEST_F(LaggingRosbridge, OldSweepsAreNone) {
  ASSERT_TRUE(sweeps_come(4s));
  bridge_->delay(800ms);
  std::this_thread::sleep_for(100ms);
  driver_->read();
  EXPECT_FALSE(sweeps_come(1200ms));
  EXPECT_FALSE(driver_->read().robot_link_up);
}

TEST_F(LaggingRosbridge, ALagThatLastsIsALostConnectionAndTheNextIsNew) {
  ASSERT_TRUE(rides(0.25));
  bridge_->delay(800ms);
  const auto begun = Clock::now();
  ride(0.25, 1000ms);
  EXPECT_TRUE(eventually([&] {
    ride(0.25, 100ms);
    return logged("it has lagged for more than");
  }));
  EXPECT_GT(Clock::now() - begun, 1500ms);
  bridge_->delay(0ms);
  EXPECT_TRUE(eventually([&] { return bridge_->connections() >= 2; }));
  EXPECT_TRUE(rides(0.25));
  EXPECT_TRUE(sweeps_come(4s));
}

}  // namespace
}  // namespace homeward::agent::rosbridge_lag_test
