// SPDX-License-Identifier: Apache-2.0
#include "agent/drivers/ros_messages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "agent/drivers/odometry_track.hpp"
#include "fuzz/mutate.hpp"
#include "support/sample_rosbridge.hpp"

namespace homeward::agent::ros_messages_test {
namespace {

using namespace homeward::testing;  // NOLINT(google-build-using-namespace): the sample messages
using nlohmann::json;

template <class T>
T decoded(const std::string& topic, const json& msg) {
  const auto message = decode_ros_message(published(topic, msg), sample_rosbridge());
  EXPECT_TRUE(message) << (message ? "" : message.error().message + " " + message.error().where);
  if (!message) return {};
  EXPECT_TRUE(std::holds_alternative<T>(*message));
  return std::get<T>(*message);
}

Error refused(const std::string& text) {
  const auto message = decode_ros_message(text, sample_rosbridge());
  EXPECT_FALSE(message) << text.substr(0, 300);
  return message ? Error{} : message.error();
}

TEST(RosSweeps, SeeWhatIsInRangeAndNothingElse) {
  const json msg = json::parse(R"({"header":{"stamp":{"sec":12,"nanosec":345678901},"frame_id":"laser"},
    "angle_min":-1.5,"angle_max":1.5,"angle_increment":0.5,"time_increment":0,"scan_time":0.1,
    "range_min":0.2,"range_max":8.0,"ranges":[1.0,null,0.1,0.2,8.0,9.5,-1,7.9],"intensities":[]})");
  const auto sweep = decoded<RosSweep>("/scan", msg);
  EXPECT_EQ(sweep.stamp_us, 12'345'678);
  EXPECT_DOUBLE_EQ(sweep.scan.angle_min_rad, -1.5);
  EXPECT_DOUBLE_EQ(sweep.scan.angle_step_rad, 0.5);
  EXPECT_DOUBLE_EQ(sweep.scan.robot_from_scan.x_m, 0.1);
  ASSERT_EQ(sweep.scan.ranges_m.size(), 8U);
  const std::vector<std::size_t> seen = {0, 3, 7};
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(std::isfinite(sweep.scan.ranges_m[i]), std::find(seen.begin(), seen.end(), i) != seen.end()) << i;
  }
  EXPECT_EQ(driving::hit_points(sweep.scan).size(), 3U);
}

TEST(RosSweeps, SeeWhatIsTooNearToMeasureWhereItIsNotTheRobotItself) {
  json msg = sweep_message(0, {0.1, 0.1, 0.1});
  msg["range_min"] = 0.45;
  msg["angle_min"] = 0.0;
  msg["angle_increment"] = 0.5 * kPi;
  wire::RosbridgeFile robot = sample_rosbridge();
  robot.body = {};
  robot.body.radius_m = 0.35;
  robot.robot_from_scan = {0.3, 0.0, 0.0};  // near its front edge: ahead is outside, behind is the robot
  const auto message = decode_ros_message(published("/scan", msg), robot);
  ASSERT_TRUE(message) << message.error().message;
  const auto& sweep = std::get<RosSweep>(*message);
  EXPECT_TRUE(std::isfinite(sweep.scan.ranges_m[0]));
  EXPECT_FALSE(std::isfinite(sweep.scan.ranges_m[1]));
  EXPECT_FALSE(std::isfinite(sweep.scan.ranges_m[2]));
  EXPECT_NEAR(sweep.blind_beyond_m, 0.4, 1e-9) << "ahead: 0.3 + 0.45 - 0.35";
}

TEST(RosSweeps, BearTheStampsOfBothRosVersions) {
  json msg = sweep_message(0, {1.0});
  msg["header"] = json::parse(R"({"seq":3,"stamp":{"secs":7,"nsecs":1000},"frame_id":"laser"})");
  EXPECT_EQ(decoded<RosSweep>("/scan", msg).stamp_us, 7'000'001);
  msg["header"]["stamp"] = {{"sec", 0}, {"nanosec", 0}};
  EXPECT_FALSE(decoded<RosSweep>("/scan", msg).stamp_us);
}

TEST(RosRanges, AreOfTheirSensorAndWithinWhatItHears) {
  wire::RosbridgeFile robot = sample_rosbridge();
  robot.ranges = sample_ring(3);
  const auto heard = [&](const json& msg) { return decode_ros_message(published("/sonar/1", msg), robot); };
  const auto range = [&](double range_m) {
    const auto message = heard(range_message(7'000'000, range_m));
    EXPECT_TRUE(message) << (message ? "" : message.error().message);
    return message ? std::get<RosRange>(*message) : RosRange{};
  };
  EXPECT_EQ(range(1.5).sensor, 1U);
  EXPECT_EQ(range(1.5).stamp_us, 7'000'000);
  EXPECT_FLOAT_EQ(range(1.5).range_m, 1.5F);
  EXPECT_FLOAT_EQ(range(0.05).range_m, 0.2F) << "too near to be measured is near";
  EXPECT_FLOAT_EQ(range(0.0).range_m, 0.2F);
  EXPECT_TRUE(std::isinf(range(3.0).range_m)) << "the file's reach";
  EXPECT_TRUE(std::isinf(range(9.0).range_m));
  json msg = range_message(7'000'000, 1.5);
  msg["max_range"] = 1.5;
  EXPECT_TRUE(std::isinf(std::get<RosRange>(*heard(msg)).range_m)) << "the sensor's own reach";
  // A null may be either infinity, near or far; a negative one is none; a switch knows no distance.
  for (const auto& [key, value] :
       {std::pair<const char*, json>{"range", json()}, {"range", -0.1}, {"max_range", 0.2}, {"min_range", json()}}) {
    json wrong = range_message(7'000'000, 1.5);
    wrong[key] = value;
    const auto refused_range = heard(wrong);
    ASSERT_FALSE(refused_range) << key;
    EXPECT_EQ(refused_range.error().where.find("/sonar/1"), 0U) << refused_range.error().where;
  }
}

TEST(RosTwists, OfTheRidersJoystickComePlainOrStamped) {
  const json twist = {{"linear", {{"x", 0.3}, {"y", 9.0}, {"z", 9.0}}},
                      {"angular", {{"x", 9.0}, {"y", 9.0}, {"z", -0.4}}}};
  for (const bool stamped : {false, true}) {
    wire::RosbridgeFile robot = sample_rosbridge();
    robot.rider =
        wire::RosRider{{"/joy_vel", stamped ? "geometry_msgs/msg/TwistStamped" : "geometry_msgs/Twist"}, true};
    const json msg = stamped ? json{{"header", ros_header(5)}, {"twist", twist}} : twist;
    const auto message = decode_ros_message(published("/joy_vel", msg), robot);
    ASSERT_TRUE(message) << message.error().message;
    ASSERT_TRUE(std::holds_alternative<RosTwist>(*message));
    EXPECT_DOUBLE_EQ(std::get<RosTwist>(*message).motion.speed_mps, 0.3);
    EXPECT_DOUBLE_EQ(std::get<RosTwist>(*message).motion.turn_radps, -0.4);
    EXPECT_EQ(std::get<RosTwist>(*message).stamp_us, stamped ? RosStamp(5) : std::nullopt);
    const auto other = decode_ros_message(published("/joy_vel", stamped ? twist : json{{"twist", twist}}), robot);
    EXPECT_FALSE(other);
  }
}

TEST(RosSweeps, AreRefusedWhenTheyDoNotHoldTogether) {
  const json good = sweep_message(1'000'000, {1.0, 2.0});
  const auto with = [&](const char* key, const json& value) {
    json msg = good;
    msg[key] = value;
    return refused(published("/scan", msg)).where;
  };
  EXPECT_EQ(with("angle_increment", 0.0), "/scan/msg/angle_increment");
  EXPECT_EQ(with("angle_increment", "small"), "/scan/msg/angle_increment");
  EXPECT_EQ(with("angle_min", 1e9), "/scan/msg/angle_min");
  EXPECT_EQ(with("angle_min", nullptr), "/scan/msg/angle_min");
  EXPECT_EQ(with("range_max", 0.0), "/scan/msg/range_max");
  EXPECT_EQ(with("range_min", -1.0), "/scan/msg/range_max");
  EXPECT_EQ(with("ranges", "AAAA"), "/scan/msg/ranges");
  EXPECT_EQ(with("ranges", json::array({1.0, "far"})), "/scan/msg/ranges");
  EXPECT_EQ(with("ranges", std::vector<double>(kMaxRosRanges + 1, 1.0)), "/scan/msg/ranges");
  EXPECT_EQ(with("header", json::object()), "/scan/msg/header/stamp");
  EXPECT_EQ(with("header", json::parse(R"({"stamp":{"sec":-4,"nanosec":0}})")), "/scan/msg/header/stamp");
}

TEST(RosOdometryMessages, GiveThePoseOnTheFloor) {
  for (const double theta_rad : {0.0, 1.0, 3.0, -2.5}) {
    const auto odometry = decoded<RosOdometry>("/odom", odometry_message(5'000'000, {1.5, -2.0, theta_rad}, 0.4));
    EXPECT_EQ(odometry.stamp_us, 5'000'000);
    EXPECT_DOUBLE_EQ(odometry.pose.x_m, 1.5);
    EXPECT_DOUBLE_EQ(odometry.pose.y_m, -2.0);
    EXPECT_NEAR(odometry.pose.theta_rad, theta_rad, 1e-9);
    EXPECT_DOUBLE_EQ(odometry.speed_mps, 0.4);
  }
}

TEST(RosOdometryMessages, AreRefusedWithoutAPose) {
  json msg = odometry_message(1, {}, 0.0);
  msg["pose"]["pose"]["orientation"] = {{"x", 0.0}, {"y", 0.0}, {"z", 0.0}, {"w", 0.0}};
  EXPECT_EQ(refused(published("/odom", msg)).where, "/odom/msg/pose/pose/orientation");
  msg = odometry_message(1, {}, 0.0);
  msg["pose"]["pose"]["position"]["x"] = nullptr;
  EXPECT_EQ(refused(published("/odom", msg)).where, "/odom/msg/pose/pose/position/x");
  msg["pose"]["pose"]["position"]["x"] = 1e300;
  EXPECT_EQ(refused(published("/odom", msg)).where, "/odom/msg/pose/pose/position");
  msg.erase("twist");
  EXPECT_EQ(refused(published("/odom", msg)).where, "/odom/msg/twist");
}

TEST(RosPictures, KeepTheirBytes) {
  const std::vector<std::uint8_t> bytes = {0xFF, 0xD8, 0x00, 0x01, 0x7F};
  EXPECT_EQ(decoded<RosPicture>("/image", picture_message(1, bytes)).bytes, bytes);
  json msg = picture_message(1, bytes);
  msg["data"] = bytes;
  EXPECT_EQ(decoded<RosPicture>("/image", msg).bytes, bytes);
  for (const json& wrong :
       {json("%%%"), json("QUJ"), json(3), json::array({1, 256}), json::array({-1}), json::array({"a"}), json()}) {
    msg["data"] = wrong;
    EXPECT_EQ(refused(published("/image", msg)).where, "/image/msg/data") << wrong;
  }
}

TEST(RosMessages, OfOtherKindsArePassedOver) {
  const auto kind = [](const std::string& text) {
    const auto message = decode_ros_message(text, sample_rosbridge());
    return message ? static_cast<int>(message->index()) : -1;
  };
  EXPECT_EQ(kind(R"({"op":"service_response","service":"/x","result":true})"), 0);
  EXPECT_EQ(kind(R"({"op":"publish","topic":"/other","msg":{"data":1}})"), 0);
  const auto status =
      decode_ros_message(R"({"op":"status","level":"error","msg":"no such topic"})", sample_rosbridge());
  ASSERT_TRUE(status);
  EXPECT_EQ(std::get<RosStatus>(*status).text, "no such topic");
}

TEST(RosMessages, OnTheWheelsTopicAreCommandsThatComeBack) {
  const json twist = {{"linear", {{"x", 0.3}}}, {"angular", {{"z", -0.4}}}};
  EXPECT_EQ(decoded<RosEcho>("/cmd_vel", twist).motion.speed_mps, 0.3);
  EXPECT_EQ(decoded<RosEcho>("/cmd_vel", twist).motion.turn_radps, -0.4);
}

TEST(RosMessages, InFragmentsAreRefusedWithWhatToDo) {
  const Error error = refused(R"({"op":"fragment","id":"0","data":"{\"op\":","num":0,"total":3})");
  EXPECT_NE(error.message.find("fragments"), std::string::npos) << error.message;
  EXPECT_NE(error.message.find("max_message_size"), std::string::npos) << error.message;
}

TEST(RosMessages, AreRefusedWhenTheyAreNone) {
  for (const char* text : {"", "{", "[]", "3", "{}", R"({"op":3})", R"({"op":""})", "\xff\xfe", "{\"op\":NaN}"}) {
    EXPECT_EQ(refused(text).code, ErrorCode::kInvalidInput) << text;
  }
  for (const char* topic : {"/scan", "/odom", "/image"}) {
    for (const json& msg : {json(), json(3), json::array(), json::object()}) refused(published(topic, msg));
    refused(R"({"op":"publish","topic":")" + std::string(topic) + "\"}");
  }
  EXPECT_EQ(refused("{\"op\":\"" + std::string(kMaxRosMessageBytes, 'a') + "\"}").code, ErrorCode::kTooLarge);
  std::string deep;
  for (int i = 0; i < 100'000; ++i) deep += "{\"op\":";
  refused(deep);
}

TEST(RosMessages, SurviveDamage) {
  Mutator mutator(11);
  const std::vector<std::string> good = {
      published("/scan", sweep_message(1'000'000, {1.0, 2.0, 3.0})),
      published("/odom", odometry_message(1'000'000, {1.0, 2.0, 0.5}, 0.2)),
      published("/image", picture_message(1'000'000, {1, 2, 3, 4, 5, 6, 7})),
  };
  int refusals = 0;
  for (const std::string& text : good) {
    for (int i = 0; i < 3000; ++i) {
      const auto message = decode_ros_message(mutator.damaged(text), sample_rosbridge());
      if (!message) {
        ++refusals;
        EXPECT_FALSE(message.error().where.empty());
        EXPECT_NE(message.error().code, ErrorCode::kInternal);
        continue;
      }
      if (const auto* odometry = std::get_if<RosOdometry>(&*message)) {
        EXPECT_TRUE(std::isfinite(odometry->pose.x_m) && std::isfinite(odometry->pose.theta_rad));
      }
      if (const auto* sweep = std::get_if<RosSweep>(&*message)) {
        for (const Eigen::Vector2d& point : driving::hit_points(sweep->scan)) EXPECT_TRUE(point.allFinite());
      }
    }
  }
  EXPECT_GT(refusals, 1000);
}

TEST(RosBodies, CoverTheirOutline) {
  wire::RosBody outline = sample_rosbridge().body;
  EXPECT_EQ(body_of(outline).outline, (Outline{0.35, 0.0, 0.0, 0.0}));
  for (const auto& [front_m, back_m, width_m] :
       {std::tuple(0.85, 0.25, 0.65), std::tuple(0.2, 0.2, 0.9), std::tuple(3.0, 3.0, 0.3)}) {
    outline.radius_m = 0.0;
    outline.front_m = front_m;
    outline.back_m = back_m;
    outline.width_m = width_m;
    const driving::Body body = body_of(outline);
    for (double along = 0.0; along <= 1.0; along += 0.01) {
      for (const double side : {-0.5, 0.0, 0.5}) {
        const std::vector<Eigen::Vector2d> point = {{-back_m + along * (front_m + back_m), side * width_m}};
        EXPECT_LE(driving::clearance_m(body, point), 1e-9) << along;
        const std::vector<Eigen::Vector2d> beside = {{point[0].x(), point[0].y() + std::copysign(0.1, side)}};
        if (side != 0.0) {
          EXPECT_NEAR(driving::clearance_m(body, beside), 0.1, 1e-9) << along;
        }
      }
    }
  }
}

TEST(OdometryTracks, TellWhereTheRobotWas) {
  OdometryTrack track;
  track.add(1'000'000, {0.0, 0.0, 3.0});
  track.add(1'100'000, {0.2, 0.1, -3.0});
  const Pose2 between = track.at(1'050'000);
  EXPECT_NEAR(between.x_m, 0.1, 1e-12);
  EXPECT_NEAR(std::abs(between.theta_rad), kPi, 1e-9);
  EXPECT_DOUBLE_EQ(track.at(900'000).x_m, 0.0);
  EXPECT_DOUBLE_EQ(track.at(1'200'000).x_m, 0.2);
  EXPECT_DOUBLE_EQ(track.at(std::nullopt).x_m, 0.2);
  EXPECT_DOUBLE_EQ(track.at(500'000'000).x_m, 0.2);
  // A clock that was set back begins anew.
  track.add(10'000, {5.0, 0.0, 0.0});
  EXPECT_DOUBLE_EQ(track.at(1'050'000).x_m, 5.0);
}

}  // namespace
}  // namespace homeward::agent::ros_messages_test
