// SPDX-License-Identifier: Apache-2.0
#include "agent/drivers/rosbridge_driver.hpp"

#include <gtest/gtest.h>

#include <mutex>
#include <thread>

#include "agent/drivers/ros_messages.hpp"
#include "imageio/decode.hpp"
#include "support/rosbridge_server.hpp"
#include "support/sample_cameras.hpp"
#include "support/sample_rosbridge.hpp"
#include "support/scratch_folder.hpp"
#include "wire/camera_json.hpp"

namespace homeward::agent {
namespace {

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
bool eventually(const std::function<bool()>& holds) {
  const auto end = Clock::now() + 4s;
  while (!holds()) {
    if (Clock::now() > end) return false;
    std::this_thread::sleep_for(5ms);
  }
  return true;
}

std::vector<std::uint8_t> sample_jpeg(int width_px = kWidth_px) {
  Image image(width_px, width_px / 2, 3);
  for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] = static_cast<std::uint8_t>(i * 7 % 251);
  return imageio::encode_jpeg(image, 90);
}

/// A driver connected with a bridge whose robot does what the test says.
class RosbridgeDriverTest : public ::testing::Test {
 protected:
  explicit RosbridgeDriverTest(const std::optional<wire::RosRider>& rider = std::nullopt)
      : bridge_(std::make_unique<RosbridgeServer>(
            static_cast<unsigned short>(0),
            RosbridgeServer::Events{[this](const std::string& topic, const json& msg) { heard(topic, msg); }})) {
    wire::RosbridgeFile robot = sample_rosbridge(bridge_->port());
    robot.rider = rider;
    if (rider) bridge_->serve_topic(rider->topic.topic, rider->topic.type);
    bridge_->serve_topic("/odom", robot.odom.type);
    bridge_->serve_topic("/scan", robot.scan.type);
    bridge_->serve_topic("/image", robot.image.type);
    bridge_->serve_topic("/cmd_vel", robot.cmd_vel.type);
    folder_.put("camera.json", wire::camera_to_json(sphere_camera(kWidth_px)).dump());
    folder_.put("robot.json", wire::rosbridge_to_json(robot).dump());
    auto driver = make_rosbridge_driver((folder_.path() / "robot.json").string(), [this](const std::string& what) {
      const std::lock_guard lock(mutex_);
      told_.push_back(what);
    });
    EXPECT_TRUE(driver) << (driver ? "" : driver.error().message + " " + driver.error().where);
    driver_ = std::move(*driver);
    EXPECT_TRUE(eventually([&] { return bridge_->subscribed().size() == (rider ? 4U : 3U); }));
  }

  void heard(const std::string& topic, const json& msg) {
    const std::lock_guard lock(mutex_);
    if (topic == "/cmd_vel") heard_.push_back({Clock::now(), msg["linear"]["x"], msg["angular"]["z"]});
  }
  std::vector<Heard> heard_since(Clock::time_point then) {
    const std::lock_guard lock(mutex_);
    std::vector<Heard> result;
    for (const Heard& one : heard_) {
      if (one.at >= then) result.push_back(one);
    }
    return result;
  }
  bool told(const std::string& part) {
    const std::lock_guard lock(mutex_);
    return std::any_of(told_.begin(), told_.end(),
                       [&](const std::string& what) { return what.find(part) != std::string::npos; });
  }
  /// Sends odometry and a sweep, as a live robot does ten times a second.
  void sense() {
    stamp_us_ += 100'000;
    bridge_->publish("/odom", odometry_message(stamp_us_, {0.001 * static_cast<double>(++sensed_), 0.0, 0.0}, 0.2));
    bridge_->publish("/scan", sweep_message(stamp_us_, {1.0, 2.0, 3.0, 4.0}));
  }
  /// Whether a sweep comes through within a while of a live robot. Meanwhile the agent commands `motion`.
  bool sweeps_come(std::chrono::milliseconds within, const Motion& motion = {}) {
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
  std::optional<TakenPicture> picture() {
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
  void drive(const Motion& motion, std::chrono::milliseconds duration) {
    const auto end = Clock::now() + duration;
    while (Clock::now() < end) {
      driver_->command(motion);
      std::this_thread::sleep_for(40ms);
    }
  }

  ScratchFolder folder_;
  std::mutex mutex_;
  std::vector<Heard> heard_;
  std::vector<std::string> told_;
  std::unique_ptr<RosbridgeServer> bridge_;
  std::unique_ptr<Driver> driver_;
  std::int64_t stamp_us_ = 50'000'000;  // the robot's clock has nothing to do with ours
  int sensed_ = 0;
};

TEST_F(RosbridgeDriverTest, TellsWhatTheRobotSenses) {
  sense();
  Reading reading;
  ASSERT_TRUE(eventually([&] {
    reading = driver_->read();
    return reading.scan.has_value();
  }));
  EXPECT_EQ(hit_points(*reading.scan).size(), 4U);
  EXPECT_DOUBLE_EQ(hit_points(*reading.scan)[0].x(), 1.1);
  EXPECT_DOUBLE_EQ(reading.speed_mps, 0.2);
  EXPECT_DOUBLE_EQ(reading.odometry.x_m, 0.001);
  EXPECT_LE(*reading.scan_t_ms, reading.t_ms);
  EXPECT_GE(*reading.scan_t_ms, reading.t_ms - 1000);
  EXPECT_FALSE(driver_->read().scan) << "a sweep is new once";
}

TEST_F(RosbridgeDriverTest, GivesPicturesAsSentWithTheOdometryOfTheirMoment) {
  bridge_->publish("/odom", odometry_message(1'000'000, {1.0, 0.0, 0.0}, 0.2));
  bridge_->publish("/odom", odometry_message(1'100'000, {2.0, 0.0, 0.0}, 0.2));
  ASSERT_TRUE(eventually([&] { return driver_->read().odometry.x_m == 2.0; }));
  bridge_->publish("/image", picture_message(1'050'000, sample_jpeg()));
  const auto taken = picture();
  ASSERT_TRUE(taken);
  ASSERT_TRUE(taken->odometry);
  EXPECT_NEAR(taken->odometry->x_m, 1.5, 1e-9);
  EXPECT_EQ(taken->jpeg, sample_jpeg());
  EXPECT_EQ(taken->picture.width_px, kWidth_px);
  // A PNG has no JPEG to keep.
  bridge_->publish("/image", picture_message(1'060'000, imageio::encode_png(taken->picture)));
  const auto png = picture();
  ASSERT_TRUE(png);
  EXPECT_TRUE(png->jpeg.empty());
}

TEST_F(RosbridgeDriverTest, PassesOverPicturesThatCannotBeRead) {
  std::vector<std::uint8_t> half = sample_jpeg();
  half.resize(half.size() / 2);
  for (const auto& bytes : {half, sample_jpeg(128), sample_jpeg(32), {}, {1, 2, 3}}) {
    bridge_->publish("/image", picture_message(stamp_us_ += 1000, bytes));
    std::this_thread::sleep_for(120ms);  // as a camera would, and above what the subscription asks for
  }
  std::stop_source stop;
  std::jthread ender([&] {
    std::this_thread::sleep_for(500ms);
    stop.request_stop();
  });
  const auto none = driver_->next_picture(stop.get_token());
  ASSERT_TRUE(none);
  EXPECT_FALSE(*none);
  EXPECT_TRUE(told("of no use"));
  bridge_->publish("/image", picture_message(stamp_us_ += 1000, sample_jpeg()));
  EXPECT_TRUE(picture());
}

TEST_F(RosbridgeDriverTest, PublishesSteadilyWhileCommandedAndThenZeroAndThenNothing) {
  const auto begun = Clock::now();
  drive({0.3, -0.2}, 600ms);
  const auto moving = heard_since(begun);
  ASSERT_GE(moving.size(), 6U);
  EXPECT_LE(moving.size(), 16U);
  for (const Heard& one : moving) {
    EXPECT_DOUBLE_EQ(one.speed_mps, 0.3);
    EXPECT_DOUBLE_EQ(one.turn_radps, -0.2);
  }
  const auto last_command = Clock::now();
  ASSERT_TRUE(eventually([&] { return heard_since(begun).back().zero(); }));
  EXPECT_LE(Clock::now() - last_command, 350ms);  // 0.15 s and a period, on a busy machine
  ASSERT_TRUE(eventually([&] { return heard_since(Clock::now() - 300ms).empty(); }));
  EXPECT_TRUE(heard_since(begun).back().zero());
}

TEST_F(RosbridgeDriverTest, AStopIsPublishedAtOnce) {
  drive({0.3, 0.0}, 300ms);
  const auto stopped = Clock::now();
  driver_->command({});
  ASSERT_TRUE(eventually([&] {
    const auto since = heard_since(stopped);
    return !since.empty() && since.back().zero();
  }));
  EXPECT_LE(Clock::now() - stopped, 200ms);
}

TEST_F(RosbridgeDriverTest, LeavesTheRobotStandingAndItsTopicsGivenBack) {
  for (int i = 0; i < 20; ++i) sense();  // bytes on their way to a driver that ends
  drive({0.3, 0.0}, 200ms);
  driver_.reset();
  ASSERT_TRUE(eventually([&] { return bridge_->received().back()["op"] == "unadvertise"; }));
  std::vector<std::string> ops;
  for (const json& message : bridge_->received()) ops.push_back(message["op"]);
  EXPECT_EQ(std::count(ops.begin(), ops.end(), "unsubscribe"), 3);
  ASSERT_FALSE(heard_since({}).empty());
  EXPECT_TRUE(heard_since({}).back().zero());
}

TEST_F(RosbridgeDriverTest, StandsAfterALostConnectionUntilTheAgentHasStoodStill) {
  ASSERT_TRUE(sweeps_come(4s));
  drive({0.4, 0.0}, 200ms);
  ASSERT_FALSE(heard_since({}).empty());
  EXPECT_FALSE(heard_since({}).back().zero());
  const auto cut = Clock::now();
  bridge_->cut();
  // The agent goes on commanding, as it would until it notices; the bridge comes back, and nothing moves.
  EXPECT_FALSE(sweeps_come(1500ms, {0.4, 0.0}));
  ASSERT_TRUE(eventually([&] { return bridge_->connections() == 2; }));
  const auto since = heard_since(cut);
  EXPECT_FALSE(since.empty()) << "a base that was left moving must be told to stand";
  for (const Heard& one : since) EXPECT_TRUE(one.zero());
  EXPECT_TRUE(told("connection lost"));
  // The agent has stopped; a newer mission may move the robot again.
  driver_->command({});
  EXPECT_TRUE(sweeps_come(4s));
  const auto again = Clock::now();
  drive({0.4, 0.0}, 200ms);
  EXPECT_FALSE(heard_since(again).back().zero());
}

TEST_F(RosbridgeDriverTest, NothingMovesWhenItConnectsAgainAfterStanding) {
  const auto begun = Clock::now();
  bridge_->refuse(true);
  EXPECT_FALSE(sweeps_come(300ms));
  bridge_->refuse(false);
  ASSERT_TRUE(eventually([&] { return bridge_->connections() == 2; }));
  EXPECT_TRUE(sweeps_come(4s));
  EXPECT_TRUE(heard_since(begun).empty());  // it never moved, so there is nothing to stop either
}

TEST_F(RosbridgeDriverTest, WithholdsSweepsWhileTheConnectionLags) {
  ASSERT_TRUE(sweeps_come(4s));
  bridge_->freeze(900ms);
  for (int i = 0; i < 5; ++i) sense();
  std::this_thread::sleep_for(500ms);
  EXPECT_FALSE(driver_->read().scan);
  std::this_thread::sleep_for(500ms);
  EXPECT_TRUE(sweeps_come(4s));
  EXPECT_EQ(bridge_->connections(), 1);
}

TEST_F(RosbridgeDriverTest, WithholdsSweepsWithoutOdometry) {
  ASSERT_TRUE(sweeps_come(4s));
  std::this_thread::sleep_for(600ms);
  bool seen = false;
  for (int i = 0; i < 10; ++i) {
    bridge_->publish("/scan", sweep_message(stamp_us_ += 100'000, {1.0, 2.0}));
    std::this_thread::sleep_for(30ms);
    seen = seen || driver_->read().scan.has_value();
  }
  EXPECT_FALSE(seen);
  EXPECT_TRUE(sweeps_come(4s));
}

TEST_F(RosbridgeDriverTest, RepeatedAndBlindSweepsAreNone) {
  ASSERT_TRUE(sweeps_come(4s));
  std::this_thread::sleep_for(100ms);
  driver_->read();
  const double infinity = std::numeric_limits<double>::infinity();
  bool seen = false;
  for (int i = 0; i < 10; ++i) {
    bridge_->publish("/odom", odometry_message(++stamp_us_, {}, 0.0));
    bridge_->publish("/scan", sweep_message(50'100'000 + 100'000'000, {1.0, 2.0}));
    std::this_thread::sleep_for(60ms);
    const bool sweep = driver_->read().scan.has_value();
    seen = seen || (i > 2 && sweep);  // the first of them is new
  }
  EXPECT_FALSE(seen) << "the same sweep again";
  for (int i = 0; i < 10; ++i) {
    bridge_->publish("/odom", odometry_message(++stamp_us_, {}, 0.0));
    bridge_->publish("/scan", sweep_message(++stamp_us_, {infinity, infinity}));
    std::this_thread::sleep_for(60ms);
    EXPECT_FALSE(driver_->read().scan);
  }
  EXPECT_TRUE(told("saw nothing at all"));
}

TEST_F(RosbridgeDriverTest, OutlivesWhatIsNoMessage) {
  for (const std::string& text :
       {std::string("{"), std::string("[]"), std::string("{\"op\":\"publish\",\"topic\":\"/scan\",\"msg\":null}"),
        std::string(100'000, '['), std::string("{\"op\":\"status\",\"level\":\"error\",\"msg\":\"bad\\nnews\"}")}) {
    bridge_->send_raw(text);
  }
  EXPECT_TRUE(eventually([&] { return told("of no use") && told("bad?news"); }));
  EXPECT_TRUE(sweeps_come(4s));
  EXPECT_EQ(bridge_->connections(), 1);
}

TEST_F(RosbridgeDriverTest, EndsAConnectionWhoseMessageIsTooLarge) {
  bridge_->send_raw("{\"op\":\"" + std::string(kMaxRosMessageBytes + 1, 'a') + "\"}");
  EXPECT_TRUE(eventually([&] { return told("larger than allowed") && bridge_->connections() == 2; }));
  driver_->command({});
  EXPECT_TRUE(sweeps_come(4s));
}

TEST_F(RosbridgeDriverTest, WaitsForARobotThatIsNotThere) {
  bridge_.reset();
  ASSERT_TRUE(eventually([&] { return told("connection lost"); }));
  driver_->command({0.4, 0.0});
  EXPECT_FALSE(driver_->read().scan);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_FALSE(*driver_->next_picture(stop.get_token()));
}

class RiderOnABridge : public RosbridgeDriverTest {
 protected:
  explicit RiderOnABridge(bool relayed = true)
      : RosbridgeDriverTest(wire::RosRider{{"/joy_vel", "geometry_msgs/msg/Twist"}, relayed}) {}

  void push(double speed_mps, double turn_radps) {
    bridge_->publish("/joy_vel", {{"linear", {{"x", speed_mps}, {"y", 0.0}, {"z", 0.0}}},
                                  {"angular", {{"x", 0.0}, {"y", 0.0}, {"z", turn_radps}}}});
  }
  /// The newest word of the hand, once it is that.
  bool says(bool deflected, const Motion& wanted) {
    return eventually([&] {
      const auto rider = driver_->read().rider;
      return rider && rider->deflected == deflected && rider->wanted.speed_mps == wanted.speed_mps &&
             rider->wanted.turn_radps == wanted.turn_radps;
    });
  }
};

TEST_F(RiderOnABridge, IsHeardWithTheTimeOfItsLastWord) {
  EXPECT_FALSE(driver_->read().rider);
  push(0.25, -0.5);
  EXPECT_TRUE(says(true, {0.25, -0.5}));
  const Reading now = driver_->read();
  EXPECT_LE(now.rider->said_ms, now.t_ms);
  std::this_thread::sleep_for(100ms);
  const Reading later = driver_->read();
  EXPECT_EQ(later.rider->said_ms, now.rider->said_ms) << "nothing was said since";
  EXPECT_GE(later.t_ms, now.t_ms + 90);
  push(0.0, 0.0);
  EXPECT_TRUE(says(false, {}));
}

TEST_F(RiderOnABridge, ATouchBetweenTwoReadingsIsNotMissed) {
  push(0.25, 0.0);
  push(0.0, 0.0);
  std::this_thread::sleep_for(300ms);
  const auto rider = driver_->read().rider;
  ASSERT_TRUE(rider);
  EXPECT_TRUE(rider->deflected);
  EXPECT_DOUBLE_EQ(rider->wanted.speed_mps, 0.0);
  EXPECT_FALSE(driver_->read().rider->deflected);
}

TEST_F(RiderOnABridge, NoiseIsNoHandAndNonsenseIsNoWord) {
  push(0.004, -0.009);
  EXPECT_TRUE(says(false, {}));
  bridge_->publish("/joy_vel", {{"linear", {{"x", nullptr}}}, {"angular", {{"z", 0.0}}}});
  EXPECT_TRUE(eventually([&] { return told("of no use"); }));
  EXPECT_TRUE(says(false, {}));
}

TEST_F(RiderOnABridge, AHandOnAConnectionThatIsLostIsNone) {
  push(0.25, 0.0);
  ASSERT_TRUE(says(true, {0.25, 0.0}));
  bridge_->cut();
  EXPECT_TRUE(eventually([&] { return !driver_->read().rider; }));
}

class RiderWhomTheBaseObeys : public RiderOnABridge {
 protected:
  RiderWhomTheBaseObeys() : RiderOnABridge(false) {}
};

TEST_F(RiderWhomTheBaseObeys, WantsNoMotionOfTheAgent) {
  push(0.25, -0.5);
  EXPECT_TRUE(says(true, {}));
}

TEST(RosbridgeFiles, AreRefusedWithWhatIsWrong) {
  const ScratchFolder folder;
  const auto told = [](const std::string&) {};
  EXPECT_EQ(make_rosbridge_driver("/nowhere/robot.json", told).error().code, ErrorCode::kNotFound);
  json robot = wire::rosbridge_to_json(sample_rosbridge());
  const std::string file = folder.put("robot.json", robot.dump()).string();
  const auto without_camera = make_rosbridge_driver(file, told);
  EXPECT_EQ(without_camera.error().code, ErrorCode::kNotFound);
  EXPECT_NE(without_camera.error().where.find("camera.json"), std::string::npos);
  robot["rider"] = {{"topic", "/cmd_vel"}, {"type", "geometry_msgs/Twist"}, {"motion", "own"}};
  folder.put("robot.json", robot.dump());
  const auto echo = make_rosbridge_driver(file, told);
  EXPECT_EQ(echo.error().code, ErrorCode::kInvalidInput);
  EXPECT_NE(echo.error().where.find("rider"), std::string::npos);
  robot.erase("rider");
  robot["address"] = "ws://robot:port";
  folder.put("robot.json", robot.dump());
  EXPECT_EQ(make_rosbridge_driver(file, told).error().where, "ws://robot:port");
}

}  // namespace
}  // namespace homeward::agent
