// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

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

/// One ultrasound sensor of a ring.
struct RosRangeSensor {
  RosTopic topic;  // of its own
  Pose2 robot_from_sensor;
  double cone_rad = 0.0;     // all that it measures in is so wide
  double range_max_m = 0.0;  // and so deep; what it says beyond is nothing
};

/// A robot behind a rosbridge (proto/schemas/rosbridge.schema.json), format "homeward-rosbridge", version 2; version 1
/// has a scan always and no ranges. A robot has a scan or ranges or both.
struct RosbridgeFile {
  std::string address;  // ws://HOST:PORT or wss://HOST:PORT, perhaps with a path
  std::string camera;   // camera.json, relative to the file
  RosTopic cmd_vel;
  RosTopic odom;
  std::optional<RosTopic> scan;
  RosTopic image;
  Pose2 robot_from_scan;  // where there is a scan
  RosBody body;
  std::optional<RosRider> rider = {};
  std::vector<RosRangeSensor> ranges = {};
};

/// As version 1 what version 1 can say, for older readers.
nlohmann::json rosbridge_to_json(const RosbridgeFile& file);

/// Strict. Errors: kInvalidInput, kUnsupportedFormat; each names the field.
Result<RosbridgeFile> rosbridge_from_json(const nlohmann::json& value, const std::string& path = "rosbridge");
Result<RosbridgeFile> parse_rosbridge(const std::string& text, const std::string& where);

}  // namespace homeward::wire
