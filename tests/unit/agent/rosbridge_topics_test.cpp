// SPDX-License-Identifier: Apache-2.0
#include "agent/drivers/rosbridge_driver.hpp"

#include "files/read_file.hpp"
#include "unit/agent/rosbridge_fixture.hpp"

namespace homeward::agent::rosbridge_topics_test {
namespace {

wire::RosbridgeFile with_commands(const std::string& type) {
  wire::RosbridgeFile robot = sample_rosbridge();
  robot.cmd_vel.type = type;
  return robot;
}

/// How a driver and a bridge agree on topics, or do not.
class RosbridgeTopics : public RosbridgeDriverTest {
 protected:
  explicit RosbridgeTopics(const std::string& commands = "geometry_msgs/msg/Twist")
      : RosbridgeDriverTest(with_commands(commands)) {}

  std::ptrdiff_t asked_for(const std::string& topic, const std::string& op = "subscribe") {
    const auto all = bridge_->received();
    return std::count_if(all.begin(), all.end(), [&](const json& message) {
      return message["op"] == op && message.value("topic", "") == topic;
    });
  }
};

TEST_F(RosbridgeTopics, AQuietRobotIsNoLostOneAndIsAskedAgain) {
  const auto end = Clock::now() + 7s;
  while (Clock::now() < end) {
    bridge_->publish("/odom", odometry_message(stamp_us(), {}, 0.0));
    std::this_thread::sleep_for(100ms);
  }
  EXPECT_EQ(bridge_->connections(), 1);
  EXPECT_TRUE(logged("nothing comes on /scan (sensor_msgs/msg/LaserScan)"));
  EXPECT_TRUE(logged("nothing comes on /image"));
  EXPECT_FALSE(logged("nothing comes on /odom"));
  EXPECT_EQ(times_logged("nothing comes on /scan"), 1);
  EXPECT_EQ(asked_for("/scan"), 3) << "at first, and once again by both names of its type";
  EXPECT_EQ(asked_for("/scan", "unsubscribe"), 1);
  EXPECT_EQ(asked_for("/odom"), 1);
}

TEST_F(RosbridgeTopics, AWhollyQuietRobotIsNoLostOne) {
  std::this_thread::sleep_for(6s);
  EXPECT_EQ(bridge_->connections(), 1);
  EXPECT_TRUE(logged("nothing comes on /odom"));
  EXPECT_FALSE(logged("connection lost"));
  EXPECT_TRUE(sweeps_come(4s));
}

class StampedCommands : public RosbridgeTopics {
 protected:
  StampedCommands() : RosbridgeTopics("geometry_msgs/msg/TwistStamped") {}
};

TEST_F(StampedCommands, BearTheRobotsTime) {
  drive({0.3, 0.0}, 300ms);
  ASSERT_FALSE(heard_since({}).empty());
  const std::lock_guard lock(mutex_);
  ASSERT_EQ(stamps_.size(), heard_.size());
  for (const std::int64_t stamp_s : stamps_) EXPECT_GT(stamp_s, 0);
}

TEST_F(RosbridgeTopics, CommandsThatAreRefusedAreMissed) {
  bridge_->serve_topic("/cmd_vel", "geometry_msgs/msg/TwistStamped");
  const auto refused = Clock::now();
  drive({0.3, 0.0}, 1500ms);
  EXPECT_TRUE(heard_since(refused).empty());
  EXPECT_TRUE(logged("no command comes back on /cmd_vel (geometry_msgs/msg/Twist)"));
  EXPECT_EQ(times_logged("no command comes back"), 1);
  bridge_->serve_topic("/cmd_vel", "geometry_msgs/msg/Twist");
  drive({0.3, 0.0}, 1500ms);
  EXPECT_TRUE(logged("commands come back on /cmd_vel"));
}

TEST_F(RosbridgeTopics, CommandsThatAreTakenAreNotMissed) {
  drive({0.3, 0.0}, 2500ms);
  EXPECT_FALSE(heard_since({}).empty());
  EXPECT_FALSE(logged("no command comes back"));
}

TEST_F(RosbridgeTopics, TheNamesOfTheOtherVersionOfRosAreUnderstood) {
  for (const auto& [topic, type] : {std::pair("/cmd_vel", "geometry_msgs/Twist"),
                                    {"/odom", "nav_msgs/Odometry"},
                                    {"/scan", "sensor_msgs/LaserScan"}}) {
    bridge_->serve_topic(topic, type);
  }
  bridge_->cut();  // the robot's computer runs ROS 1
  ASSERT_TRUE(eventually([&] { return bridge_->connections() == 2; }));
  EXPECT_FALSE(sweeps_come(500ms));
  EXPECT_TRUE(sweeps_come(8s));
  EXPECT_TRUE(logged("nothing comes on /scan"));
}

TEST_F(RosbridgeTopics, ABridgeThatWantsAPasswordIsAskedLessAndLessOften) {
  bridge_->authenticate();
  bridge_->cut();
  std::this_thread::sleep_for(4s);
  EXPECT_LE(bridge_->connections(), 6) << "after 0.2, 0.4, 0.8, 1.6 and 2 s, not five times a second";
  EXPECT_EQ(times_logged("parameter 'authenticate'"), 1);
  EXPECT_LE(times_logged("connected to"), 2);
}

TEST_F(RosbridgeTopics, WholeMessagesAreAskedForWhereABridgeSendsFragments) {
  bridge_->fragment(500);
  bridge_->cut();
  ASSERT_TRUE(eventually([&] { return bridge_->connections() == 2; }));
  driver_->command({});
  ASSERT_TRUE(sweeps_come(4s));
  bridge_->publish("/image", picture_message(stamp_us(), sample_jpeg()));
  EXPECT_TRUE(picture());
}

TEST_F(RosbridgeTopics, TheLastZeroIsTakenUpBeforeTheConnectionCloses) {
  drive({0.3, 0.0}, 300ms);
  bridge_->take_up_after(150ms);
  drive({0.3, 0.0}, 300ms);
  driver_.reset();
  std::this_thread::sleep_for(500ms);
  ASSERT_FALSE(heard_since({}).empty());
  EXPECT_TRUE(heard_since({}).back().zero());
}

TEST_F(RosbridgeTopics, AnAddressMayHaveAPath) {
  json robot = json::parse(files::read_text((folder_.path() / "robot.json").string()).value());
  robot["address"] = robot["address"].get<std::string>() + "/chair/rosbridge?of=2";
  folder_.put("deeper.json", robot.dump());
  const auto driver = make_rosbridge_driver((folder_.path() / "deeper.json").string(), [](const std::string&) {});
  ASSERT_TRUE(driver) << driver.error().message;
  EXPECT_TRUE(eventually([&] {
    const auto paths = bridge_->paths();
    return std::find(paths.begin(), paths.end(), "/chair/rosbridge?of=2") != paths.end();
  }));
}

}  // namespace
}  // namespace homeward::agent::rosbridge_topics_test
