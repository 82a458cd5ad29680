// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <mutex>
#include <thread>

#include "agent/drivers/ros_messages.hpp"
#include "agent/drivers/rosbridge_driver.hpp"
#include "imageio/decode.hpp"
#include "support/rosbridge_server.hpp"
#include "support/sample_cameras.hpp"
#include "support/sample_rosbridge.hpp"
#include "support/scratch_folder.hpp"
#include "wire/camera_json.hpp"

namespace homeward::agent {

using namespace std::chrono_literals;
using namespace homeward::testing;  // NOLINT(google-build-using-namespace): the sample messages
using Clock = std::chrono::steady_clock;
using nlohmann::json;

constexpr int kWidth_px = 64;

struct Heard {
  Clock::time_point at;
  double speed_mps = 0.0;
  double turn_radps = 0.0;
  [[nodiscard]] bool zero() const { return speed_mps == 0.0 && turn_radps == 0.0; }
};

/// Waits up to four seconds; slow machines need them, others do not.
inline bool eventually(const std::function<bool()>& holds) {
  const auto end = Clock::now() + 4s;
  while (!holds()) {
    if (Clock::now() > end) return false;
    std::this_thread::sleep_for(5ms);
  }
  return true;
}

inline std::vector<std::uint8_t> sample_jpeg(int width_px = kWidth_px) {
  Image image(width_px, width_px / 2, 3);
  for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = static_cast<std::uint8_t>(i * 7 % 251);
  return imageio::encode_jpeg(image, 90);
}

/// A driver connected with a bridge whose robot does what the test says.
class RosbridgeDriverTest : public ::testing::Test {
 protected:
  RosbridgeDriverTest() : RosbridgeDriverTest(sample_rosbridge()) {}
  /// `robot`: its address is that of the test's bridge.
  explicit RosbridgeDriverTest(wire::RosbridgeFile robot)
      : bridge_(std::make_unique<RosbridgeServer>(
            static_cast<unsigned short>(0),
            RosbridgeServer::Events{[this](const std::string& topic, const json& msg) { heard(topic, msg); }})) {
    robot.address = sample_rosbridge(bridge_->port()).address;
    std::vector<wire::RosTopic> sensed = {robot.odom, robot.image};
    if (robot.scan) sensed.push_back(*robot.scan);
    if (robot.rider) sensed.push_back(robot.rider->topic);
    for (const wire::RosRangeSensor& sensor : robot.ranges) sensed.push_back(sensor.topic);
    for (const wire::RosTopic& topic : sensed) bridge_->serve_topic(topic.topic, topic.type);
    bridge_->serve_topic("/cmd_vel", robot.cmd_vel.type);
    folder_.put("camera.json", wire::camera_to_json(sphere_camera(kWidth_px)).dump());
    folder_.put("robot.json", wire::rosbridge_to_json(robot).dump());
    auto driver = make_rosbridge_driver((folder_.path() / "robot.json").string(), [this](const std::string& what) {
      const std::lock_guard lock(mutex_);
      log_.push_back(what);
    });
    EXPECT_TRUE(driver) << (driver ? "" : driver.error().message + " " + driver.error().where);
    driver_ = std::move(*driver);
    const std::size_t listened_to = sensed.size() + 1;  // and to the commands as they come back
    EXPECT_TRUE(eventually([&] { return bridge_->subscribed().size() == listened_to; }));
  }

  void heard(const std::string& topic, const json& msg) {
    const std::lock_guard lock(mutex_);
    if (topic != "/cmd_vel") return;
    const json& twist = msg.contains("twist") ? msg["twist"] : msg;
    heard_.push_back({Clock::now(), twist["linear"]["x"], twist["angular"]["z"]});
    if (msg.contains("header")) stamps_.push_back(msg["header"]["stamp"]["sec"]);
  }
  std::vector<Heard> heard_since(Clock::time_point then) {
    const std::lock_guard lock(mutex_);
    std::vector<Heard> result;
    for (const Heard& one : heard_) {
      if (one.at >= then) result.push_back(one);
    }
    return result;
  }
  bool logged(const std::string& part) {
    const std::lock_guard lock(mutex_);
    return std::any_of(log_.begin(), log_.end(),
                       [&](const std::string& what) { return what.find(part) != std::string::npos; });
  }
  /// How often a line with this was logged.
  std::ptrdiff_t times_logged(const std::string& part) {
    const std::lock_guard lock(mutex_);
    return std::count_if(log_.begin(), log_.end(),
                         [&](const std::string& what) { return what.find(part) != std::string::npos; });
  }
  /// Now by the robot's clock, which has nothing to do with ours but its speed. Never the same twice.
  std::int64_t stamp_us() {
    const auto elapsed = std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - begun_);
    return stamp_us_ = std::max<std::int64_t>(stamp_us_ + 1, 50'000'000 + elapsed.count());
  }
  /// Sends odometry and a sweep, as a live robot does ten times a second.
  void sense() {
    const std::int64_t now_us = stamp_us();
    bridge_->publish("/odom", odometry_message(now_us, {0.001 * static_cast<double>(++moments_), 0.0, 0.0}, 0.2));
    bridge_->publish("/scan", sweep_message(now_us, {1.0, 2.0, 3.0, 4.0}));
  }
  /// Whether a sweep comes through within a while of a live robot. Meanwhile the agent commands `motion`.
  bool sweeps_come(std::chrono::milliseconds within, const driving::Motion& motion = {}) {
    const auto end = Clock::now() + within;
    while (Clock::now() < end) {
      sense();
      std::this_thread::sleep_for(30ms);
      driver_->command(motion);
      if (driver_->read().scan) return true;
    }
    return false;
  }
  /// The next picture, or nothing within four seconds.
  std::optional<driving::TakenPicture> picture() {
    std::stop_source stop;
    const std::jthread ender([&stop](const std::stop_token& over) {
      const auto end = Clock::now() + 4s;
      while (!over.stop_requested() && Clock::now() < end) std::this_thread::sleep_for(5ms);
      stop.request_stop();
    });
    auto taken = driver_->next_picture(stop.get_token());
    EXPECT_TRUE(taken);
    return taken ? std::move(*taken) : std::nullopt;
  }
  void drive(const driving::Motion& motion, std::chrono::milliseconds duration) {
    const auto end = Clock::now() + duration;
    while (Clock::now() < end) {
      driver_->command(motion);
      std::this_thread::sleep_for(40ms);
    }
  }

  ScratchFolder folder_;
  std::mutex mutex_;
  std::vector<Heard> heard_;
  std::vector<std::int64_t> stamps_;  // of the Twists that bear one, in seconds
  std::vector<std::string> log_;
  std::unique_ptr<RosbridgeServer> bridge_;
  std::unique_ptr<driving::Driver> driver_;
  Clock::time_point begun_ = Clock::now();
  std::int64_t stamp_us_ = 0;  // the newest
  int moments_ = 0;            // that were sensed
};

}  // namespace homeward::agent
