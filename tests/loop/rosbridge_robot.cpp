// SPDX-License-Identifier: Apache-2.0
// A simulated robot behind the tests' rosbridge: odometry, sweeps and pictures ten times a second. It obeys the last
// Twist until the next one comes, or for so many seconds where TIMEOUT_S is given. SIGUSR1 silences its camera and
// SIGUSR2 its range sensor, until the signal comes again.
// usage: homeward-rosbridge-robot PORT WORLD START_ROOM disc|chair TRUTH_FILE CAMERA_FILE [TIMEOUT_S]
#include <atomic>
#include <chrono>
#include <csignal>
#include <deque>
#include <fstream>
#include <iostream>
#include <mutex>
#include <thread>
#include <utility>

#include "imageio/decode.hpp"
#include "scenario/simulator_driver.hpp"
#include "support/rosbridge_server.hpp"
#include "support/sample_rosbridge.hpp"
#include "wire/camera_json.hpp"

namespace {

using namespace homeward;  // NOLINT(google-build-using-namespace): a program's own file
using Clock = std::chrono::steady_clock;

std::atomic<bool> ended{false};
std::atomic<bool> camera_silent{false};
std::atomic<bool> scanner_silent{false};

/// The robot's clock, by which its messages are stamped. The simulation's own falls behind where the machine is busy,
/// as no clock of a robot does.
class RobotClock {
 public:
  /// The simulation has come so far.
  std::int64_t note(driving::Milliseconds simulated_ms) {
    const std::lock_guard lock(mutex_);
    noted_.push_back({simulated_ms, now_us()});
    while (noted_.size() > kMostNoted) noted_.pop_front();
    return noted_.back().second;
  }
  /// When it was there.
  std::int64_t stamp_us(driving::Milliseconds simulated_ms) {
    const std::lock_guard lock(mutex_);
    for (auto noted = noted_.rbegin(); noted != noted_.rend(); ++noted) {
      if (noted->first <= simulated_ms) return noted->second;
    }
    return now_us();
  }

 private:
  static std::int64_t now_us() {
    return std::chrono::duration_cast<std::chrono::microseconds>(Clock::now().time_since_epoch()).count();
  }

  static constexpr std::size_t kMostNoted = 500;  // ten seconds
  std::mutex mutex_;
  std::deque<std::pair<driving::Milliseconds, std::int64_t>> noted_;
};

void send_pictures(driving::Driver& robot, RobotClock& clock, testing::RosbridgeServer& bridge,
                   const std::stop_token& stop) {
  constexpr int kQuality = 90;
  while (!stop.stop_requested()) {
    const auto taken = robot.next_picture(stop);
    if (!taken || !*taken) return;
    if (camera_silent) continue;
    bridge.publish("/image", testing::picture_message(clock.stamp_us((*taken)->t_ms),
                                                      imageio::encode_jpeg((*taken)->picture, kQuality)));
  }
}

int run(const std::vector<std::string>& arguments) {
  scenario::SimulatorDriverConfig config;
  config.world = arguments[2];
  config.start_room = arguments[3];
  config.robot = arguments[4];
  config.truth_file = arguments[5];
  const auto made = scenario::make_simulator_driver(config);
  if (!made) {
    std::cerr << made.error().message << " (" << made.error().where << ")\n";
    return 1;
  }
  driving::Driver& robot = **made;

  const double timeout_s = arguments.size() > 7 ? std::stod(arguments[7]) : 1e9;
  std::mutex mutex;
  driving::Motion twist;
  Clock::time_point heard = Clock::now();
  testing::RosbridgeServer bridge(static_cast<unsigned short>(std::stoi(arguments[1])),
                                  {[&](const std::string& topic, const nlohmann::json& msg) {
                                    if (topic != "/cmd_vel") return;
                                    const std::lock_guard lock(mutex);
                                    heard = Clock::now();
                                    twist = {msg["linear"]["x"].get<double>(), msg["angular"]["z"].get<double>()};
                                  }});
  bridge.take_up_after(std::chrono::milliseconds(5));
  const wire::RosbridgeFile described = testing::sample_rosbridge();
  for (const wire::RosTopic* topic : {&described.cmd_vel, &described.odom, &*described.scan, &described.image}) {
    bridge.serve_topic(topic->topic, topic->type);
  }
  // Last: who finds this file finds the bridge listening.
  std::ofstream(arguments[6]) << wire::camera_to_json(robot.camera()).dump();

  RobotClock clock;
  std::jthread pictures([&](const std::stop_token& stop) { send_pictures(robot, clock, bridge, stop); });
  constexpr auto kTick = std::chrono::milliseconds(20);
  constexpr int kTicksPerSweep = 5;
  auto next = Clock::now();
  for (int tick = 0; !ended; ++tick) {
    {
      const std::lock_guard lock(mutex);
      if (std::chrono::duration<double>(Clock::now() - heard).count() > timeout_s) twist = {};
      robot.command(twist);
    }
    const driving::Reading reading = robot.read();
    const std::int64_t stamp_us = clock.note(reading.t_ms);
    if (tick % kTicksPerSweep == 0) {
      bridge.publish("/odom", testing::odometry_message(stamp_us, reading.odometry, reading.speed_mps));
      const std::vector<double> ranges_m(reading.scan->ranges_m.begin(), reading.scan->ranges_m.end());
      if (!scanner_silent)
        bridge.publish("/scan", testing::sweep_message(stamp_us, ranges_m, reading.scan->range_max_m));
    }
    next = std::max(next + kTick, Clock::now());
    std::this_thread::sleep_until(next);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv, argv + argc);
  if (arguments.size() != 7 && arguments.size() != 8) {
    std::cerr
        << "usage: homeward-rosbridge-robot PORT WORLD START_ROOM disc|chair TRUTH_FILE CAMERA_FILE [TIMEOUT_S]\n";
    return 2;
  }
  std::signal(SIGTERM, [](int) { ended = true; });
  std::signal(SIGINT, [](int) { ended = true; });
  std::signal(SIGUSR1, [](int) { camera_silent = !camera_silent; });
  std::signal(SIGUSR2, [](int) { scanner_silent = !scanner_silent; });
  return run(arguments);
}
