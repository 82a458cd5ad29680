// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sodium.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/angles.hpp"
#include "core/pose2.hpp"
#include "wire/rosbridge_json.hpp"

namespace homeward::testing {

/// A small round robot of ROS 2.
inline wire::RosbridgeFile sample_rosbridge(unsigned short port = 9090) {
  wire::RosbridgeFile robot;
  robot.address = "ws://127.0.0.1:" + std::to_string(port);
  robot.camera = "camera.json";
  robot.cmd_vel = {"/cmd_vel", "geometry_msgs/msg/Twist"};
  robot.odom = {"/odom", "nav_msgs/msg/Odometry"};
  robot.scan = {"/scan", "sensor_msgs/msg/LaserScan"};
  robot.image = {"/image", "sensor_msgs/msg/CompressedImage"};
  robot.robot_from_scan = {0.1, 0.0, 0.0};
  robot.body.radius_m = 0.35;
  robot.body.max_speed_mps = 0.8;
  robot.body.max_turn_radps = 1.2;
  return robot;
}

/// Ultrasound sensors with cones of 40 degrees looking outwards from a circle, topics /sonar/0, ..., the first ahead
/// and each the next to the left. Nine of them cover all round.
inline std::vector<wire::RosRangeSensor> sample_ring(int sensors, double apart_rad = radians(40.0),
                                                     double radius_m = 0.3) {
  std::vector<wire::RosRangeSensor> ring;
  for (int i = 0; i < sensors; ++i) {
    const double angle_rad = wrap_angle(i * apart_rad);
    ring.push_back({{"/sonar/" + std::to_string(i), "sensor_msgs/msg/Range"},
                    {radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad), angle_rad},
                    radians(40.0),
                    3.0});
  }
  return ring;
}

inline nlohmann::json ros_header(std::int64_t stamp_us) {
  return {{"stamp", {{"sec", stamp_us / 1'000'000}, {"nanosec", stamp_us % 1'000'000 * 1000}}}, {"frame_id", "base"}};
}

/// Rays all round; what is not finite is null, as a rosbridge writes it.
inline nlohmann::json sweep_message(std::int64_t stamp_us, const std::vector<double>& ranges_m,
                                    double range_max_m = 12.0) {
  nlohmann::json ranges = nlohmann::json::array();
  for (const double range_m : ranges_m) {
    ranges.push_back(std::isfinite(range_m) ? nlohmann::json(range_m) : nlohmann::json());
  }
  const double step_rad = 2.0 * kPi / static_cast<double>(ranges_m.size());
  return {{"header", ros_header(stamp_us)},
          {"angle_min", 0.0},
          {"angle_max", 2.0 * kPi - step_rad},
          {"angle_increment", std::min(step_rad, kPi)},
          {"time_increment", 0.0},
          {"scan_time", 0.1},
          {"range_min", 0.02},
          {"range_max", range_max_m},
          {"ranges", ranges},
          {"intensities", nlohmann::json::array()}};
}

/// What one ultrasound sensor says.
inline nlohmann::json range_message(std::int64_t stamp_us, double range_m) {
  return {{"header", ros_header(stamp_us)},
          {"radiation_type", 0},
          {"field_of_view", 0.7},
          {"min_range", 0.2},
          {"max_range", 4.0},
          {"range", range_m}};
}

inline nlohmann::json odometry_message(std::int64_t stamp_us, const Pose2& pose, double speed_mps) {
  const nlohmann::json turn = {
      {"x", 0.0}, {"y", 0.0}, {"z", std::sin(0.5 * pose.theta_rad)}, {"w", std::cos(0.5 * pose.theta_rad)}};
  const nlohmann::json at = {{"position", {{"x", pose.x_m}, {"y", pose.y_m}, {"z", 0.0}}}, {"orientation", turn}};
  const nlohmann::json twist = {{"linear", {{"x", speed_mps}, {"y", 0.0}, {"z", 0.0}}},
                                {"angular", {{"x", 0.0}, {"y", 0.0}, {"z", 0.0}}}};
  return {{"header", ros_header(stamp_us)},
          {"child_frame_id", "base_link"},
          {"pose", {{"pose", at}, {"covariance", std::vector<double>(36, 0.0)}}},
          {"twist", {{"twist", twist}, {"covariance", std::vector<double>(36, 0.0)}}}};
}

inline nlohmann::json picture_message(std::int64_t stamp_us, const std::vector<std::uint8_t>& bytes) {
  std::string text(sodium_base64_encoded_len(bytes.size(), sodium_base64_VARIANT_ORIGINAL), '\0');
  sodium_bin2base64(text.data(), text.size(), bytes.data(), bytes.size(), sodium_base64_VARIANT_ORIGINAL);
  text.pop_back();  // the terminating zero
  return {{"header", ros_header(stamp_us)}, {"format", "jpeg"}, {"data", text}};
}

/// As a bridge sends it to a client.
inline std::string published(const std::string& topic, const nlohmann::json& msg) {
  return nlohmann::json{{"op", "publish"}, {"topic", topic}, {"msg", msg}}.dump();
}

}  // namespace homeward::testing
