// SPDX-License-Identifier: Apache-2.0
#include "agent/drivers/rosbridge_feeds.hpp"

#include <gtest/gtest.h>

#include "support/sample_rosbridge.hpp"

namespace homeward::agent::rosbridge_feeds_test {
namespace {

using driving::Milliseconds;
using driving::Motion;

bool stands(const Motion& motion) { return motion.speed_mps == 0.0 && motion.turn_radps == 0.0; }

/// A robot with a joystick whose clock is 1000 s behind ours. Its messages are 20 ms under way unless a test says more.
class RosbridgeFeedsTest : public ::testing::Test {
 protected:
  explicit RosbridgeFeedsTest(bool relayed = true, const std::string& twist = "geometry_msgs/msg/Twist")
      : feeds_(ridden(relayed, twist), config_) {
    feeds_.begin(now_ms_);
  }

  static wire::RosbridgeFile ridden(bool relayed, const std::string& twist) {
    wire::RosbridgeFile robot = testing::sample_rosbridge();
    robot.rider = wire::RosRider{{"/joy_vel", twist}, relayed};
    return robot;
  }

  [[nodiscard]] std::int64_t stamp_us(Milliseconds under_way_ms) const {
    return 1000 * (now_ms_ - 1'000'000 - under_way_ms);
  }
  std::string odometry(Milliseconds under_way_ms = 20) {
    return feeds_.take(RosOdometry{stamp_us(under_way_ms), {1.0, 2.0, 0.0}, 0.3}, now_ms_);
  }
  std::string sweep(Milliseconds under_way_ms = 20) {
    RosSweep message{stamp_us(under_way_ms), {}, 0.0};
    message.scan.ranges_m = {1.0F, 2.0F};
    return feeds_.take(std::move(message), now_ms_);
  }
  std::string push(const Motion& motion, RosStamp stamp = std::nullopt) {
    return feeds_.take(RosTwist{stamp, motion}, now_ms_);
  }
  driving::Reading read(bool live = true) { return feeds_.reading(live, false, now_ms_); }
  /// Time passes with odometry and sweeps ten times a second.
  void live_on(Milliseconds time_ms) {
    for (const Milliseconds end_ms = now_ms_ + time_ms; now_ms_ < end_ms;) {
      now_ms_ += 100;
      EXPECT_EQ(odometry(), "");
      EXPECT_EQ(sweep(), "");
    }
  }

  Milliseconds now_ms_ = 5'000'000;
  RosbridgeConfig config_;
  RosbridgeFeeds feeds_;
};

TEST_F(RosbridgeFeedsTest, ANewHandMovesTheRobot) {
  live_on(1000);
  EXPECT_EQ(push({0.25, -0.5}), "");
  ASSERT_TRUE(read().rider);
  EXPECT_EQ(read().rider->said_ms, now_ms_);
  EXPECT_TRUE(read().rider->deflected);
  EXPECT_DOUBLE_EQ(read().rider->wanted.speed_mps, 0.25);
  EXPECT_DOUBLE_EQ(read().rider->wanted.turn_radps, -0.5);
}

TEST_F(RosbridgeFeedsTest, AHandOnALinkThatIsNotLiveMovesNothingButIsOne) {
  live_on(1000);
  push({0.25, -0.5});
  const driving::Reading reading = read(false);
  ASSERT_TRUE(reading.rider);
  EXPECT_TRUE(reading.rider->deflected) << "it ends a mission all the same";
  EXPECT_TRUE(stands(reading.rider->wanted));
  EXPECT_FALSE(reading.scan);
  EXPECT_FALSE(reading.robot_link_up);
}

TEST_F(RosbridgeFeedsTest, AHandWhileThePingsAreSlowIsPassedOver) {
  live_on(1000);
  feeds_.pinged(900, now_ms_);
  EXPECT_NE(push({0.25, 0.0}).find("lags by 0.9 s"), std::string::npos);
  EXPECT_TRUE(read().rider->deflected);
  EXPECT_TRUE(stands(read().rider->wanted));
  live_on(600);
  feeds_.pinged(20, now_ms_);
  EXPECT_EQ(push({0.25, 0.0}), "");
  EXPECT_DOUBLE_EQ(read().rider->wanted.speed_mps, 0.25);
}

TEST_F(RosbridgeFeedsTest, AHandWithoutAStampIsAsOldAsWhatComesBesideIt) {
  live_on(1000);
  // The bridge held everything for two seconds, and lets it go at once. Pings did not see it.
  now_ms_ += 2000;
  EXPECT_NE(push({0.25, 0.0}), "") << "the Twist comes first";
  EXPECT_NE(odometry(2010), "");
  EXPECT_NE(push({0.25, 0.0}), "");
  EXPECT_EQ(odometry(20), "") << "and then what is new";
  EXPECT_NE(push({0.25, 0.0}), "") << "but which the hand is nobody knows";
  EXPECT_TRUE(stands(read().rider->wanted));
  EXPECT_FALSE(read().robot_link_up);
  live_on(600);
  EXPECT_EQ(push({0.25, 0.0}), "");
}

TEST_F(RosbridgeFeedsTest, AHandWhileNothingWithAStampComesMayBeOld) {
  live_on(1000);
  now_ms_ += 250;
  EXPECT_EQ(push({0.25, 0.0}), "");
  now_ms_ += 100;
  EXPECT_NE(push({0.25, 0.0}), "");
}

TEST_F(RosbridgeFeedsTest, OfARobotWithoutStampsThePingsTell) {
  now_ms_ += config_.lag.remembered_ms;
  EXPECT_EQ(push({0.25, 0.0}), "");
  feeds_.pinged(400, now_ms_);
  EXPECT_NE(push({0.25, 0.0}), "");
}

TEST_F(RosbridgeFeedsTest, AHandOnAConnectionJustMadeIsPassedOver) {
  EXPECT_NE(push({0.25, 0.0}).find("just made"), std::string::npos);
  EXPECT_TRUE(read().rider->deflected);
  EXPECT_TRUE(stands(read().rider->wanted));
}

TEST_F(RosbridgeFeedsTest, AtRestNothingIsPassedOver) {
  EXPECT_EQ(push({0.0, 0.0}), "");
  EXPECT_FALSE(read().rider->deflected);
}

class HandWhomTheBaseObeys : public RosbridgeFeedsTest {
 protected:
  HandWhomTheBaseObeys() : RosbridgeFeedsTest(false) {}
};

TEST_F(HandWhomTheBaseObeys, EndsMissionsHoweverOldItIs) {
  feeds_.pinged(900, now_ms_);
  EXPECT_EQ(push({0.25, 0.0}), "") << "no motion of it is obeyed";
  EXPECT_TRUE(read(false).rider->deflected);
}

class StampedHand : public RosbridgeFeedsTest {
 protected:
  StampedHand() : RosbridgeFeedsTest(true, "geometry_msgs/msg/TwistStamped") {}
};

TEST_F(StampedHand, IsAsOldAsItsStampSays) {
  live_on(1000);
  EXPECT_EQ(push({0.25, 0.0}, stamp_us(20)), "");
  live_on(100);
  EXPECT_NE(push({0.25, 0.0}, stamp_us(420)).find("0.4 s old"), std::string::npos);
  EXPECT_TRUE(stands(read().rider->wanted));
  live_on(100);
  EXPECT_EQ(push({0.25, 0.0}, stamp_us(20)), "");
  EXPECT_DOUBLE_EQ(read().rider->wanted.speed_mps, 0.25);
}

TEST_F(StampedHand, ThatRepeatsItselfSaysNothingNew) {
  live_on(1000);
  const std::int64_t stamp = stamp_us(20);
  EXPECT_EQ(push({0.25, 0.0}, stamp), "");
  EXPECT_NE(push({0.25, 0.0}, stamp), "");
  EXPECT_TRUE(stands(read().rider->wanted));
}

TEST_F(RosbridgeFeedsTest, OldSweepsAndOdometryAreNone) {
  live_on(1000);
  ASSERT_TRUE(read().scan);
  now_ms_ += 100;
  EXPECT_NE(sweep(400).find("/scan was 0.4 s old"), std::string::npos);
  EXPECT_FALSE(read().scan);
  EXPECT_NE(odometry(600), "");
  live_on(100);
  EXPECT_TRUE(read().scan);
  // Odometry that is always old is a silent one.
  for (int i = 0; i < 6; ++i) {
    now_ms_ += 100;
    odometry(600 + i);
    EXPECT_EQ(sweep(), "");
  }
  EXPECT_FALSE(read().scan);
}

TEST_F(RosbridgeFeedsTest, PicturesMayBeOlderSinceTheyBearTheirOdometry) {
  live_on(1000);
  EXPECT_EQ(feeds_.take(RosPicture{stamp_us(100), {1}}, now_ms_), "");
  EXPECT_EQ(feeds_.take(RosPicture{stamp_us(700), {2}}, now_ms_), "");
  ASSERT_TRUE(feeds_.has_picture());
  EXPECT_EQ(feeds_.picture()->bytes, std::vector<std::uint8_t>{2});
  EXPECT_FALSE(feeds_.has_picture());
  EXPECT_NE(feeds_.take(RosPicture{stamp_us(1300), {3}}, now_ms_), "");
  EXPECT_FALSE(feeds_.has_picture());
  EXPECT_EQ(push({0.25, 0.0}), "") << "a slow camera is no slow connection";
}

TEST_F(RosbridgeFeedsTest, ALostConnectionIsForgottenAndTheNextLearnsItsDelayAnew) {
  live_on(1000);
  push({0.25, 0.0});
  feeds_.lose();
  EXPECT_FALSE(read().rider);
  EXPECT_FALSE(read().scan);
  feeds_.begin(now_ms_);
  now_ms_ += 100;
  EXPECT_EQ(odometry(5000), "") << "the robot's clock was set back meanwhile";
  now_ms_ += 100;
  EXPECT_EQ(odometry(5000), "");
}

TEST_F(RosbridgeFeedsTest, SilentTopicsAreNamedOnceAndAskedForAgainAndAgain) {
  const Milliseconds begun_ms = now_ms_;
  live_on(config_.topic_silence_ms);
  const auto silent = feeds_.silent_topics(now_ms_);
  ASSERT_EQ(silent.size(), 2U);
  EXPECT_EQ(silent[0].subscription.topic.topic, "/image");
  EXPECT_TRUE(silent[0].first);
  EXPECT_EQ(silent[1].subscription.topic.topic, "/joy_vel");
  EXPECT_TRUE(feeds_.silent_topics(now_ms_ + 100).empty());
  live_on(config_.topic_silence_ms);
  push({0.0, 0.0});
  const auto still = feeds_.silent_topics(now_ms_);
  ASSERT_EQ(still.size(), 1U) << "a joystick that was heard once may be at rest";
  EXPECT_FALSE(still[0].first);
  EXPECT_EQ(feeds_.take(RosPicture{stamp_us(100), {1}}, now_ms_), "");
  live_on(config_.topic_silence_ms);
  const auto again = feeds_.silent_topics(now_ms_);
  ASSERT_EQ(again.size(), 1U);
  EXPECT_TRUE(again[0].first) << "another silence";
  EXPECT_GE(now_ms_ - begun_ms, 3 * config_.topic_silence_ms);
}

TEST_F(RosbridgeFeedsTest, OldWordsAreNoSilence) {
  for (int i = 0; i < 60; ++i) {
    now_ms_ += 100;
    odometry(20 + 40 * i);
    sweep(20 + 40 * i);
    feeds_.take(RosPicture{stamp_us(20 + 40 * i), {1}}, now_ms_);
    push({0.0, 0.0});
    EXPECT_TRUE(feeds_.silent_topics(now_ms_).empty());
  }
}

}  // namespace
}  // namespace homeward::agent::rosbridge_feeds_test
