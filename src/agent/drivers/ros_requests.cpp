// SPDX-License-Identifier: Apache-2.0
#include "agent/drivers/ros_requests.hpp"

#include <nlohmann/json.hpp>

#include "agent/drivers/ros_messages.hpp"

namespace homeward::agent {
namespace {

using nlohmann::json;

constexpr const char* kFrame = "base_link";  // of REP 105
constexpr int kOdometryLeast_ms = 20;
constexpr int kRangesLeast_ms = 40;
constexpr int kPicturesLeast_ms = 90;  // ten pictures a second are enough

/// The same type as the other version of ROS writes it.
std::string other_name(const std::string& type) {
  const std::size_t msg = type.find("/msg/");
  if (msg != std::string::npos) return type.substr(0, msg) + type.substr(msg + 4);
  const std::size_t slash = type.find('/');
  return type.substr(0, slash) + "/msg" + type.substr(slash);
}

std::string advertisement(const wire::RosTopic& topic) {
  return json{{"op", "advertise"}, {"id", "homeward:cmd_vel"}, {"topic", topic.topic}, {"type", topic.type}}.dump();
}

std::string request(const RosSubscription& subscription) {
  return json{{"op", "subscribe"},
              {"id", "homeward:" + subscription.topic.topic},
              {"topic", subscription.topic.topic},
              {"type", subscription.topic.type},
              {"throttle_rate", subscription.least_ms},
              {"queue_length", 1},  // of what waits only the newest matters
              {"fragment_size", kMaxRosMessageBytes},
              {"compression", "none"}}
      .dump();
}

std::string ended(const wire::RosTopic& topic) {
  return json{{"op", "unsubscribe"}, {"id", "homeward:" + topic.topic}, {"topic", topic.topic}}.dump();
}

/// `cmd_vel` itself: each command as it comes back.
RosSubscription echo(const wire::RosbridgeFile& robot) { return {robot.cmd_vel, 0}; }

std::vector<RosSubscription> all_topics(const wire::RosbridgeFile& robot) {
  std::vector<RosSubscription> all;
  if (robot.rider) all.push_back(rider_topic(robot));
  for (RosSubscription& sensed : sensed_topics(robot)) all.push_back(std::move(sensed));
  all.push_back(echo(robot));
  return all;
}

json vector3(double x, double z) { return {{"x", x}, {"y", 0.0}, {"z", z}}; }

}  // namespace

std::vector<RosSubscription> sensed_topics(const wire::RosbridgeFile& robot) {
  std::vector<RosSubscription> topics = {{robot.odom, kOdometryLeast_ms}};
  if (robot.scan) topics.push_back({*robot.scan, kRangesLeast_ms});
  topics.push_back({robot.image, kPicturesLeast_ms});
  for (const wire::RosRangeSensor& sensor : robot.ranges) topics.push_back({sensor.topic, kRangesLeast_ms});
  return topics;
}

RosSubscription rider_topic(const wire::RosbridgeFile& robot) {
  // Each reading of the joystick, at once.
  return {robot.rider->topic, 0};
}

std::vector<std::string> ros_greeting(const wire::RosbridgeFile& robot) {
  std::vector<std::string> texts = {advertisement(robot.cmd_vel)};
  for (const RosSubscription& subscription : all_topics(robot)) texts.push_back(request(subscription));
  return texts;
}

std::vector<std::string> ros_asked_again(const RosSubscription& subscription) {
  RosSubscription renamed = subscription;
  renamed.topic.type = other_name(subscription.topic.type);
  return {ended(subscription.topic), request(renamed), request(subscription)};
}

std::vector<std::string> ros_advertised_again(const wire::RosbridgeFile& robot) {
  std::vector<std::string> texts = ros_asked_again(echo(robot));
  texts.push_back(advertisement({robot.cmd_vel.topic, other_name(robot.cmd_vel.type)}));
  texts.push_back(advertisement(robot.cmd_vel));
  return texts;
}

std::vector<std::string> ros_farewell(const wire::RosbridgeFile& robot) {
  std::vector<std::string> texts;
  for (const RosSubscription& subscription : all_topics(robot)) texts.push_back(ended(subscription.topic));
  texts.push_back(json{{"op", "unadvertise"}, {"id", "homeward:cmd_vel"}, {"topic", robot.cmd_vel.topic}}.dump());
  return texts;
}

std::string ros_motion(const wire::RosbridgeFile& robot, const driving::Motion& motion) {
  json twist = {{"linear", vector3(motion.speed_mps, 0.0)}, {"angular", vector3(0.0, motion.turn_radps)}};
  if (is_stamped(robot.cmd_vel.type)) twist = {{"header", {{"frame_id", kFrame}}}, {"twist", twist}};
  return json{{"op", "publish"}, {"topic", robot.cmd_vel.topic}, {"msg", twist}}.dump();
}

}  // namespace homeward::agent
