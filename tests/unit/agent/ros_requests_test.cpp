// SPDX-License-Identifier: Apache-2.0
#include "agent/drivers/ros_requests.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "agent/drivers/ros_messages.hpp"
#include "support/sample_rosbridge.hpp"

namespace homeward::agent::ros_requests_test {
namespace {

using namespace homeward::testing;  // NOLINT(google-build-using-namespace): the sample messages
using nlohmann::json;

std::vector<json> parsed(const std::vector<std::string>& texts) {
  std::vector<json> messages;
  for (const std::string& text : texts) messages.push_back(json::parse(text));
  return messages;
}

std::ptrdiff_t count(const std::vector<std::string>& texts, const std::string& op, const std::string& topic) {
  const std::vector<json> messages = parsed(texts);
  return std::ranges::count_if(messages, [&](const json& message) {
    return message["op"] == op && message["topic"].get<std::string>().starts_with(topic);
  });
}

TEST(RosGreeting, AdvertisesAndSubscribesWithTypes) {
  const auto texts = ros_greeting(sample_rosbridge());
  ASSERT_EQ(texts.size(), 5U);
  const json first = json::parse(texts[0]);
  EXPECT_EQ(first["op"], "advertise");
  EXPECT_EQ(first["type"], "geometry_msgs/msg/Twist");
  const json scan = json::parse(texts[2]);
  EXPECT_EQ(scan["op"], "subscribe");
  EXPECT_EQ(scan["topic"], "/scan");
  EXPECT_EQ(scan["queue_length"], 1);
  EXPECT_GT(scan["throttle_rate"], 0);
  EXPECT_EQ(scan["fragment_size"], kMaxRosMessageBytes) << "whole messages, whatever the bridge is set to";
}

TEST(RosGreeting, ListensToTheCommandsThemselves) {
  const auto texts = ros_greeting(sample_rosbridge());
  EXPECT_EQ(count(texts, "subscribe", "/cmd_vel"), 1);
  EXPECT_EQ(count(ros_farewell(sample_rosbridge()), "unsubscribe", "/cmd_vel"), 1);
}

TEST(RosGreeting, AsksForRingAndJoystickAndTheFarewellGivesThemBack) {
  wire::RosbridgeFile robot = sample_rosbridge();
  robot.ranges = sample_ring(3);
  robot.rider = wire::RosRider{{"/joy_vel", "geometry_msgs/Twist"}, true};
  EXPECT_EQ(count(ros_greeting(robot), "subscribe", "/sonar/"), 3);
  EXPECT_EQ(count(ros_farewell(robot), "unsubscribe", "/sonar/"), 3);
  EXPECT_EQ(count(ros_greeting(robot), "subscribe", "/joy_vel"), 1);
  EXPECT_EQ(count(ros_farewell(robot), "unsubscribe", "/joy_vel"), 1);
}

TEST(RosTopics, AreAskedForAgainByBothNamesOfTheirType) {
  for (const char* type : {"sensor_msgs/msg/LaserScan", "sensor_msgs/LaserScan"}) {
    const auto messages = parsed(ros_asked_again({{"/scan", type}, 40}));
    ASSERT_EQ(messages.size(), 3U);
    EXPECT_EQ(messages[0]["op"], "unsubscribe");
    EXPECT_EQ(messages[1]["op"], "subscribe");
    EXPECT_NE(messages[1]["type"], type);
    EXPECT_TRUE(messages[1]["type"] == "sensor_msgs/msg/LaserScan" || messages[1]["type"] == "sensor_msgs/LaserScan");
    EXPECT_EQ(messages[2]["op"], "subscribe");
    EXPECT_EQ(messages[2]["type"], type);
    EXPECT_EQ(messages[2]["throttle_rate"], 40);
  }
}

TEST(RosMotion, IsATwistOrAStampedOne) {
  wire::RosbridgeFile robot = sample_rosbridge();
  EXPECT_EQ(json::parse(ros_motion(robot, {0.25, -0.5})), json::parse(R"({"op":"publish","topic":"/cmd_vel","msg":
    {"linear":{"x":0.25,"y":0.0,"z":0.0},"angular":{"x":0.0,"y":0.0,"z":-0.5}}})"));
  robot.cmd_vel.type = "geometry_msgs/TwistStamped";
  EXPECT_EQ(json::parse(ros_motion(robot, {0.25, 0.0}))["msg"]["twist"]["linear"]["x"], 0.25);
}

TEST(RosMotion, LeavesTheStampOfItsHeaderToTheBridge) {
  wire::RosbridgeFile robot = sample_rosbridge();
  robot.cmd_vel.type = "geometry_msgs/TwistStamped";
  const json msg = json::parse(ros_motion(robot, {0.25, 0.0}))["msg"];
  ASSERT_TRUE(msg.contains("header")) << "a bridge stamps headers that are there";
  EXPECT_EQ(msg["header"], json::parse(R"({"frame_id":"base_link"})"));
}

}  // namespace
}  // namespace homeward::agent::ros_requests_test
