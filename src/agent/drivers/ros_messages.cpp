// SPDX-License-Identifier: Apache-2.0
#include "agent/drivers/ros_messages.hpp"

#include <sodium.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "wire/json_reader.hpp"

namespace homeward::agent {
namespace {

using nlohmann::json;

/// Messages hold more than the agent needs, so these readers, unlike those of our own formats, pass over other keys.
class Fields {
 public:
  explicit Fields(const json& value, std::string path) : value_(value), path_(std::move(path)) {}

  const json& at(const std::string& key) {
    static const json kNull;
    if (value_.is_object()) {
      if (const auto found = value_.find(key); found != value_.end()) return *found;
    }
    problem(key, "'" + key + "' is missing.");
    return kNull;
  }
  Fields inside(const std::string& key) {
    Fields inner(at(key), path_ + "/" + key);
    inner.error_ = error_;
    return inner;
  }
  double number(const std::string& key) {
    const json& found = at(key);
    if (!found.is_number() || !std::isfinite(found.get<double>())) {
      problem(key, "'" + key + "' must be a finite number.");
      return 0.0;
    }
    return found.get<double>();
  }
  [[nodiscard]] bool has(const std::string& key) const { return value_.is_object() && value_.contains(key); }
  void problem(const std::string& key, const std::string& message) {
    if (!*error_) *error_ = Error{ErrorCode::kInvalidInput, message, path_ + "/" + key};
  }
  [[nodiscard]] const std::optional<Error>& error() const { return *error_; }

 private:
  const json& value_;
  std::string path_;
  std::shared_ptr<std::optional<Error>> error_ = std::make_shared<std::optional<Error>>();
};

/// ROS 1 writes a stamp as secs and nsecs, ROS 2 as sec and nanosec.
RosStamp stamp_of(Fields& message) {
  Fields header = message.inside("header");
  Fields stamp = header.inside("stamp");
  const bool ros1 = stamp.has("secs");
  const double seconds = stamp.number(ros1 ? "secs" : "sec");
  const double nanoseconds = stamp.number(ros1 ? "nsecs" : "nanosec");
  if (!(seconds >= 0.0 && seconds < 9e9 && nanoseconds >= 0.0 && nanoseconds < 1e9)) {
    header.problem("stamp", "The stamp is out of range.");
    return std::nullopt;
  }
  const auto stamp_us =
      static_cast<std::int64_t>(seconds) * 1'000'000 + static_cast<std::int64_t>(nanoseconds / 1000.0);
  return stamp_us == 0 ? RosStamp() : stamp_us;
}

RosSweep sweep_of(Fields& message, const Pose2& robot_from_scan, const Outline& body) {
  RosSweep sweep{stamp_of(message), {}, 0.0};
  driving::Scan& scan = sweep.scan;
  scan.robot_from_scan = robot_from_scan;
  scan.angle_min_rad = message.number("angle_min");
  scan.angle_step_rad = message.number("angle_increment");
  scan.range_max_m = message.number("range_max");
  const double range_min_m = message.number("range_min");
  if (std::abs(scan.angle_min_rad) > 4.0 * kPi) message.problem("angle_min", "The angle is out of range.");
  const double step_rad = std::abs(scan.angle_step_rad);
  if (!(step_rad > 1e-6 && step_rad <= kPi)) message.problem("angle_increment", "The step is out of range.");
  if (!(range_min_m >= 0.0 && scan.range_max_m > range_min_m && scan.range_max_m <= 1000.0)) {
    message.problem("range_max", "The least and greatest range do not fit.");
  }
  const json& ranges = message.at("ranges");
  if (!ranges.is_array() || ranges.size() > kMaxRosRanges) {
    message.problem("ranges", "'ranges' must be a list of at most " + std::to_string(kMaxRosRanges) + " numbers.");
    return sweep;
  }
  scan.ranges_m.reserve(ranges.size());
  for (const json& range : ranges) {
    if (!range.is_number() && !range.is_null()) {
      message.problem("ranges", "A range must be a number or null.");
      return sweep;
    }
    const double range_m = range.is_null() ? 0.0 : range.get<double>();
    const double angle_rad = robot_from_scan.theta_rad + scan.angle_min_rad +
                             static_cast<double>(scan.ranges_m.size()) * scan.angle_step_rad;
    const auto beyond_m = [&](double at_m) {
      return distance_m(
          body, {robot_from_scan.x_m + at_m * std::cos(angle_rad), robot_from_scan.y_m + at_m * std::sin(angle_rad)});
    };
    sweep.blind_beyond_m = std::max(sweep.blind_beyond_m, beyond_m(range_min_m));
    // Too near to be measured well is near all the same, unless it is the robot itself.
    const bool near = range_m >= range_min_m || beyond_m(range_m) > 0.0;
    const bool seen = std::isfinite(range_m) && range_m > 0.0 && near && range_m < scan.range_max_m;
    scan.ranges_m.push_back(seen ? static_cast<float>(range_m) : std::numeric_limits<float>::infinity());
  }
  return sweep;
}

RosRange range_of(Fields& message, std::size_t sensor, double reach_m) {
  const double range_min_m = message.number("min_range");
  const double range_max_m = message.number("max_range");
  const double range_m = message.number("range");
  // With equal bounds it is a sensor that only says whether something is there, by infinities that JSON has not.
  if (!(range_min_m >= 0.0 && range_max_m > range_min_m && range_max_m <= 1000.0)) {
    message.problem("max_range", "The least and greatest range do not fit.");
  }
  if (range_m < 0.0) message.problem("range", "A range must not be negative.");
  RosRange range{stamp_of(message), sensor, std::numeric_limits<float>::infinity(), static_cast<float>(range_min_m)};
  if (range_m < std::min(reach_m, range_max_m)) {
    range.range_m = std::max(static_cast<float>(range_m), range.range_min_m);
  }
  return range;
}

RosOdometry odometry_of(Fields& message) {
  RosOdometry odometry;
  odometry.stamp_us = stamp_of(message);
  Fields pose = message.inside("pose").inside("pose");
  Fields position = pose.inside("position");
  Fields orientation = pose.inside("orientation");
  Fields velocity = message.inside("twist").inside("twist").inside("linear");
  odometry.pose.x_m = position.number("x");
  odometry.pose.y_m = position.number("y");
  odometry.speed_mps = velocity.number("x");
  const double x = orientation.number("x");
  const double y = orientation.number("y");
  const double z = orientation.number("z");
  const double w = orientation.number("w");
  const double norm = x * x + y * y + z * z + w * w;
  if (!(norm > 0.5 && norm < 2.0)) {
    pose.problem("orientation", "The orientation is no unit quaternion.");
    return odometry;
  }
  if (std::abs(odometry.pose.x_m) > 1e6 || std::abs(odometry.pose.y_m) > 1e6) {
    pose.problem("position", "The position is out of range.");
  }
  // The turn about the vertical (yaw of REP 103).
  odometry.pose.theta_rad = std::atan2(2.0 * (w * z + x * y), norm - 2.0 * (y * y + z * z));
  return odometry;
}

/// Bytes come as base64 text; early bridges for ROS 2 send lists of numbers.
std::vector<std::uint8_t> bytes_of(Fields& message, const std::string& key) {
  const json& data = message.at(key);
  std::vector<std::uint8_t> bytes;
  if (data.is_string()) {
    const auto& text = data.get_ref<const std::string&>();
    bytes.resize(text.size() / 4 * 3 + 3);
    std::size_t count = 0;
    const int wrong = sodium_base642bin(bytes.data(), bytes.size(), text.data(), text.size(), "\r\n", &count, nullptr,
                                        sodium_base64_VARIANT_ORIGINAL);
    if (wrong != 0) message.problem(key, "The bytes are no base64 text.");
    bytes.resize(wrong != 0 ? 0 : count);
    return bytes;
  }
  if (data.is_array()) {
    bytes.reserve(data.size());
    for (const json& item : data) {
      const bool fits = item.is_number_unsigned() && item.get<std::uint64_t>() <= 255;
      if (!fits) {
        message.problem(key, "A byte must be a whole number from 0 to 255.");
        return {};
      }
      bytes.push_back(static_cast<std::uint8_t>(item.get<std::uint64_t>()));
    }
    return bytes;
  }
  message.problem(key, "'" + key + "' must be base64 text.");
  return bytes;
}

std::string text_at(const json& value, const char* key) {
  const auto found = value.find(key);
  return found != value.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// Of a Twist, or of a TwistStamped and then with its stamp.
RosTwist twist_of(Fields& message, const std::string& type) {
  RosTwist twist;
  if (is_stamped(type)) twist.stamp_us = stamp_of(message);
  Fields fields = is_stamped(type) ? message.inside("twist") : message;
  Fields linear = fields.inside("linear");
  Fields angular = fields.inside("angular");
  twist.motion = {linear.number("x"), angular.number("z")};
  return twist;
}

}  // namespace

Result<RosMessage> decode_ros_message(std::string_view text, const wire::RosbridgeFile& robot) {
  auto parsed = wire::parse_json(std::string(text), "rosbridge", kMaxRosMessageBytes, 16);
  if (!parsed) return pass_on(parsed);
  const std::string op = parsed->is_object() ? text_at(*parsed, "op") : std::string();
  if (op.empty()) return fail(ErrorCode::kInvalidInput, "A message of a rosbridge must have an 'op'.", "rosbridge/op");
  if (op == "status") {
    const std::string level = text_at(*parsed, "level");
    return RosMessage(RosStatus{level, text_at(*parsed, "msg")});
  }
  if (op == "fragment") {
    return fail(ErrorCode::kInvalidInput,
                "The rosbridge sends a message in fragments (its parameter max_message_size): let it send them whole.",
                "rosbridge/op");
  }
  if (op != "publish") return RosMessage(RosOther{});
  const std::string topic = text_at(*parsed, "topic");
  Fields fields(*parsed, topic);
  Fields message = fields.inside("msg");
  RosMessage result = RosOther{};
  if (robot.scan && topic == robot.scan->topic) {
    result = sweep_of(message, robot.robot_from_scan, body_of(robot.body).outline);
  }
  for (std::size_t i = 0; i < robot.ranges.size(); ++i) {
    if (topic == robot.ranges[i].topic.topic) result = range_of(message, i, robot.ranges[i].range_max_m);
  }
  if (topic == robot.odom.topic) result = odometry_of(message);
  if (topic == robot.image.topic) {
    RosPicture picture{stamp_of(message), bytes_of(message, "data")};
    result = std::move(picture);
  }
  if (robot.rider && topic == robot.rider->topic.topic) result = twist_of(message, robot.rider->topic.type);
  if (topic == robot.cmd_vel.topic) result = RosEcho{twist_of(message, robot.cmd_vel.type).motion};
  if (message.error()) return tl::unexpected<Error>(*message.error());
  return result;
}

bool is_stamped(const std::string& type) { return type.ends_with("Stamped"); }

driving::Body body_of(const wire::RosBody& outline) {
  driving::Body body;
  body.max_speed_mps = outline.max_speed_mps;
  body.max_turn_radps = outline.max_turn_radps;
  body.deceleration_mps2 = outline.deceleration_mps2;
  body.turn_deceleration_radps2 = outline.turn_deceleration_radps2;
  if (outline.radius_m > 0.0) {
    body.outline = {outline.radius_m, 0.0, 0.0, 0.0};
  } else {
    body.outline = {0.0, outline.back_m, outline.front_m, 0.5 * outline.width_m};
  }
  return body;
}

}  // namespace homeward::agent
