// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "core/pose2.hpp"
#include "core/result.hpp"

namespace homeward::wire {

struct RosTopic {
  std::string topic;
  std::string type;  // as ROS 1 ("sensor_msgs/LaserScan") or ROS 2 ("sensor_msgs/msg/LaserScan") names it
};

/// A robot's outline about the point that it turns on, and how fast it may move.
struct RosBody {
  double radius_m = 0.0;  // of a round body; 0: it is a rectangle
  double front_m = 0.0;   // from the turning point to the front,
  double back_m = 0.0;    // and to the back
  double width_m = 0.0;
  double max_speed_mps = 0.0;
  double max_turn_radps = 0.0;
  double deceleration_mps2 = 1.0;
  double turn_deceleration_radps2 = 3.0;
};

/// The rider's own joystick.
struct RosRider {
  RosTopic topic;
  bool relayed = true;  // false: the base obeys it by itself
};

/// A robot behind a rosbridge (proto/schemas/rosbridge.schema.json), format "homeward-rosbridge", version 1.
struct RosbridgeFile {
  std::string address;  // ws://HOST:PORT
  std::string camera;   // camera.json, relative to the file
  RosTopic cmd_vel;
  RosTopic odom;
  RosTopic scan;
  RosTopic image;
  Pose2 robot_from_scan;
  RosBody body;
  std::optional<RosRider> rider = {};
};

nlohmann::json rosbridge_to_json(const RosbridgeFile& file);

/// Strict. Errors: kInvalidInput, kUnsupportedFormat; each names the field.
Result<RosbridgeFile> rosbridge_from_json(const nlohmann::json& value, const std::string& path = "rosbridge");
Result<RosbridgeFile> parse_rosbridge(const std::string& text, const std::string& where);

}  // namespace homeward::wire
