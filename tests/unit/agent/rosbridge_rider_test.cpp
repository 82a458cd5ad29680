// SPDX-License-Identifier: Apache-2.0
#include "agent/drivers/rosbridge_driver.hpp"

#include "unit/agent/rosbridge_fixture.hpp"

namespace homeward::agent::rosbridge_rider_test {
namespace {

wire::RosbridgeFile ridden(bool relayed) {
  wire::RosbridgeFile robot = sample_rosbridge();
  robot.rider = wire::RosRider{{"/joy_vel", "geometry_msgs/msg/Twist"}, relayed};
  return robot;
}

class RiderOnABridge : public RosbridgeDriverTest {
 protected:
  explicit RiderOnABridge(bool relayed = true) : RosbridgeDriverTest(ridden(relayed)) {
    std::this_thread::sleep_for(600ms);  // a connection that was just made is no word of a hand
  }

  void push(double speed_mps, double turn_radps) {
    bridge_->publish("/joy_vel", {{"linear", {{"x", speed_mps}, {"y", 0.0}, {"z", 0.0}}},
                                  {"angular", {{"x", 0.0}, {"y", 0.0}, {"z", turn_radps}}}});
  }
  /// The newest word of the hand, once it is that.
  bool says(bool deflected, const driving::Motion& wanted) {
    return eventually([&] {
      const auto rider = driver_->read().rider;
      return rider && rider->deflected == deflected && rider->wanted.speed_mps == wanted.speed_mps &&
             rider->wanted.turn_radps == wanted.turn_radps;
    });
  }
};

TEST_F(RiderOnABridge, IsHeardWithTheTimeOfItsLastWord) {
  EXPECT_FALSE(driver_->read().rider);
  push(0.25, -0.5);
  EXPECT_TRUE(says(true, {0.25, -0.5}));
  const driving::Reading now = driver_->read();
  EXPECT_LE(now.rider->said_ms, now.t_ms);
  std::this_thread::sleep_for(100ms);
  const driving::Reading later = driver_->read();
  EXPECT_EQ(later.rider->said_ms, now.rider->said_ms) << "nothing was said since";
  EXPECT_GE(later.t_ms, now.t_ms + 90);
  push(0.0, 0.0);
  EXPECT_TRUE(says(false, {}));
}

TEST_F(RiderOnABridge, ATouchBetweenTwoReadingsIsNotMissed) {
  push(0.25, 0.0);
  push(0.0, 0.0);
  std::this_thread::sleep_for(300ms);
  const auto rider = driver_->read().rider;
  ASSERT_TRUE(rider);
  EXPECT_TRUE(rider->deflected);
  EXPECT_DOUBLE_EQ(rider->wanted.speed_mps, 0.0);
  EXPECT_FALSE(driver_->read().rider->deflected);
}

TEST_F(RiderOnABridge, NoiseIsNoHandAndNonsenseIsNoWord) {
  push(0.004, -0.009);
  EXPECT_TRUE(says(false, {}));
  bridge_->publish("/joy_vel", {{"linear", {{"x", nullptr}}}, {"angular", {{"z", 0.0}}}});
  EXPECT_TRUE(eventually([&] { return logged("of no use"); }));
  EXPECT_TRUE(says(false, {}));
}

TEST_F(RiderOnABridge, AHandOnAConnectionThatIsLostIsNone) {
  push(0.25, 0.0);
  ASSERT_TRUE(says(true, {0.25, 0.0}));
  bridge_->cut();
  EXPECT_TRUE(eventually([&] { return !driver_->read().rider; }));
}

class RiderWhomTheBaseObeys : public RiderOnABridge {
 protected:
  RiderWhomTheBaseObeys() : RiderOnABridge(false) {}
};

TEST_F(RiderWhomTheBaseObeys, WantsNoMotionOfTheAgent) {
  push(0.25, -0.5);
  EXPECT_TRUE(says(true, {}));
}

}  // namespace
}  // namespace homeward::agent::rosbridge_rider_test
