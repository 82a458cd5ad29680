// SPDX-License-Identifier: Apache-2.0
#include "wire/rosbridge_json.hpp"

#include <algorithm>

#include "wire/json_reader.hpp"

namespace homeward::wire {
namespace {

using nlohmann::json;

constexpr double kMaxOffset_m = 5.0;

/// The names of a message type in ROS 1 and in ROS 2.
std::vector<std::string> both(const std::string& package, const std::string& type) {
  return {package + "/" + type, package + "/msg/" + type};
}

bool is_topic(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '/' ||
           c == '~';
  });
}

void read_topic(ObjectReader& reader, RosTopic& topic, const std::vector<std::string>& types) {
  topic.topic = reader.text("topic", 256);
  if (!is_topic(topic.topic)) reader.problem("topic", "A topic consists of letters, digits, '_', '/' and '~'.");
  topic.type = reader.choice("type", types);
}

RosTopic topic_at(ObjectReader& reader, const std::string& key, const std::vector<std::string>& types) {
  ObjectReader inner(reader.value(key), reader.path_of(key));
  RosTopic topic;
  read_topic(inner, topic, types);
  if (const Status status = inner.finish(); !status) return reader.take<RosTopic>(pass_on(status));
  return topic;
}

/// Where a sensor sits on the robot.
Pose2 mount_at(ObjectReader& reader, const std::string& key) {
  ObjectReader mount(reader.value(key), reader.path_of(key));
  const Pose2 pose{mount.number("x_m", -kMaxOffset_m, kMaxOffset_m), mount.number("y_m", -kMaxOffset_m, kMaxOffset_m),
                   mount.number("theta_rad", -kPi, kPi)};
  if (const Status status = mount.finish(); !status) reader.take<double>(pass_on(status));
  return pose;
}

void read_scan(ObjectReader& reader, RosbridgeFile& file) {
  ObjectReader inner(reader.value("scan"), reader.path_of("scan"));
  file.scan.emplace();
  read_topic(inner, *file.scan, both("sensor_msgs", "LaserScan"));
  file.robot_from_scan = mount_at(inner, "robot_from_scan");
  if (const Status status = inner.finish(); !status) reader.take<double>(pass_on(status));
}

void read_ranges(ObjectReader& reader, RosbridgeFile& file) {
  constexpr std::size_t kMostSensors = 32;
  const std::vector<json> sensors = reader.array("ranges", kMostSensors);
  if (sensors.empty())
    reader.problem("ranges", "'ranges' lists the sensors of the ring; leave it out where there are none.");
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    ObjectReader inner(sensors[i], reader.path_of("ranges") + "/" + std::to_string(i));
    RosRangeSensor sensor;
    read_topic(inner, sensor.topic, both("sensor_msgs", "Range"));
    sensor.robot_from_sensor = mount_at(inner, "robot_from_sensor");
    sensor.cone_rad = inner.number("cone_rad", 0.02, 1.6);
    sensor.range_max_m = inner.number("range_max_m", 0.3, 20.0);
    const bool again = std::ranges::any_of(
        file.ranges, [&](const RosRangeSensor& other) { return other.topic.topic == sensor.topic.topic; });
    if (again) inner.problem("topic", "Each sensor of the ring needs a topic of its own.");
    if (const Status status = inner.finish(); !status) reader.take<double>(pass_on(status));
    file.ranges.push_back(std::move(sensor));
  }
}

RosRider read_rider(ObjectReader& reader, const std::vector<std::string>& types) {
  ObjectReader inner(reader.value("rider"), reader.path_of("rider"));
  RosRider rider;
  read_topic(inner, rider.topic, types);
  rider.relayed = inner.choice("motion", {"relayed", "own"}) == "relayed";
  if (const Status status = inner.finish(); !status) return reader.take<RosRider>(pass_on(status));
  return rider;
}

RosBody read_body(ObjectReader& reader) {
  ObjectReader inner(reader.value("body"), reader.path_of("body"));
  RosBody body;
  if (inner.has("rectangle")) {
    ObjectReader rectangle(inner.value("rectangle"), inner.path_of("rectangle"));
    body.front_m = rectangle.number("front_m", 0.05, 3.0);
    body.back_m = rectangle.number("back_m", 0.05, 3.0);
    body.width_m = rectangle.number("width_m", 0.1, 3.0);
    if (const Status status = rectangle.finish(); !status) inner.take<double>(pass_on(status));
    if (inner.has("radius_m")) inner.problem("radius_m", "A body is either round or a rectangle.");
  } else {
    body.radius_m = inner.number("radius_m", 0.05, 3.0);
  }
  body.max_speed_mps = inner.number("max_speed_mps", 0.05, 2.0);
  body.max_turn_radps = inner.number("max_turn_radps", 0.05, 4.0);
  if (inner.has("deceleration_mps2")) body.deceleration_mps2 = inner.number("deceleration_mps2", 0.1, 10.0);
  if (inner.has("turn_deceleration_radps2")) {
    body.turn_deceleration_radps2 = inner.number("turn_deceleration_radps2", 0.1, 50.0);
  }
  if (const Status status = inner.finish(); !status) return reader.take<RosBody>(pass_on(status));
  return body;
}

json topic_to_json(const RosTopic& topic) { return {{"topic", topic.topic}, {"type", topic.type}}; }

json mount_to_json(const Pose2& pose) { return {{"x_m", pose.x_m}, {"y_m", pose.y_m}, {"theta_rad", pose.theta_rad}}; }

}  // namespace

json rosbridge_to_json(const RosbridgeFile& file) {
  json body = {{"max_speed_mps", file.body.max_speed_mps},
               {"max_turn_radps", file.body.max_turn_radps},
               {"deceleration_mps2", file.body.deceleration_mps2},
               {"turn_deceleration_radps2", file.body.turn_deceleration_radps2}};
  if (file.body.radius_m > 0.0) {
    body["radius_m"] = file.body.radius_m;
  } else {
    body["rectangle"] = {{"front_m", file.body.front_m}, {"back_m", file.body.back_m}, {"width_m", file.body.width_m}};
  }
  json value = {{"format", "homeward-rosbridge"},
                {"version", file.scan && file.ranges.empty() ? 1 : 2},
                {"address", file.address},
                {"camera", file.camera},
                {"cmd_vel", topic_to_json(file.cmd_vel)},
                {"odom", topic_to_json(file.odom)},
                {"image", topic_to_json(file.image)},
                {"body", body}};
  if (file.scan) {
    value["scan"] = topic_to_json(*file.scan);
    value["scan"]["robot_from_scan"] = mount_to_json(file.robot_from_scan);
  }
  for (const RosRangeSensor& sensor : file.ranges) {
    json entry = topic_to_json(sensor.topic);
    entry["robot_from_sensor"] = mount_to_json(sensor.robot_from_sensor);
    entry["cone_rad"] = sensor.cone_rad;
    entry["range_max_m"] = sensor.range_max_m;
    value["ranges"].push_back(std::move(entry));
  }
  if (file.rider) {
    value["rider"] = topic_to_json(file.rider->topic);
    value["rider"]["motion"] = file.rider->relayed ? "relayed" : "own";
  }
  return value;
}

Result<RosbridgeFile> rosbridge_from_json(const json& value, const std::string& path) {
  ObjectReader reader(value, path);
  const int version = reader.format("homeward-rosbridge", 1, 2);
  RosbridgeFile file;
  file.address = reader.text("address", 300);
  const bool websocket = file.address.starts_with("ws://") || file.address.starts_with("wss://");
  if (!websocket || file.address.ends_with("://")) {
    reader.problem("address", "The address of a rosbridge looks like ws://192.168.1.7:9090.");
  }
  file.camera = reader.text("camera");
  if (file.camera.empty()) reader.problem("camera", "'camera' names the robot's camera.json.");
  std::vector<std::string> twists = both("geometry_msgs", "Twist");
  for (const std::string& stamped : both("geometry_msgs", "TwistStamped")) twists.push_back(stamped);
  file.cmd_vel = topic_at(reader, "cmd_vel", twists);
  file.odom = topic_at(reader, "odom", both("nav_msgs", "Odometry"));
  const bool ranges = version >= 2 && reader.has("ranges");
  if (ranges) read_ranges(reader, file);
  if (!ranges || reader.has("scan")) read_scan(reader, file);
  file.image = topic_at(reader, "image", both("sensor_msgs", "CompressedImage"));
  if (reader.has("rider")) file.rider = read_rider(reader, twists);
  if (file.rider && file.rider->topic.topic == file.cmd_vel.topic) {
    reader.problem("rider",
                   "The rider's topic must be another than cmd_vel: the agent would take its own Twists for a hand.");
  }
  file.body = read_body(reader);
  if (const Status status = reader.finish(); !status) return pass_on(status);
  return file;
}

Result<RosbridgeFile> parse_rosbridge(const std::string& text, const std::string& where) {
  const Result<json> value = parse_json(text, where, 65536);
  if (!value) return pass_on(value);
  return rosbridge_from_json(*value, where);
}

}  // namespace homeward::wire
