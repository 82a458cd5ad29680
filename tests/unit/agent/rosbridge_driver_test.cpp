// SPDX-License-Identifier: Apache-2.0
#include "agent/drivers/rosbridge_driver.hpp"

#include "unit/agent/rosbridge_fixture.hpp"

namespace homeward::agent::rosbridge_driver_test {
namespace {

TEST_F(RosbridgeDriverTest, TellsWhatTheRobotSenses) {
  sense();
  driving::Reading reading;
  ASSERT_TRUE(eventually([&] {
    reading = driver_->read();
    return reading.scan.has_value();
  }));
  EXPECT_EQ(driving::hit_points(*reading.scan).size(), 4U);
  EXPECT_DOUBLE_EQ(driving::hit_points(*reading.scan)[0].x(), 1.1);
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
    bridge_->publish("/image", picture_message(stamp_us(), bytes));
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
  EXPECT_TRUE(logged("of no use"));
  bridge_->publish("/image", picture_message(stamp_us(), sample_jpeg()));
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
  EXPECT_EQ(std::count(ops.begin(), ops.end(), "unsubscribe"), 4) << "three of sensors, and the commands' own";
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
  EXPECT_TRUE(logged("connection lost"));
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
    bridge_->publish("/scan", sweep_message(stamp_us(), {1.0, 2.0}));
    std::this_thread::sleep_for(30ms);
    seen = seen || driver_->read().scan.has_value();
  }
  EXPECT_FALSE(seen);
  EXPECT_TRUE(sweeps_come(4s));
}

TEST_F(RosbridgeDriverTest, SweepsAreNoYoungerThanTheWordOfTheWheels) {
  ASSERT_TRUE(sweeps_come(4s));
  const driving::Milliseconds silent_since_ms = driver_->read().t_ms;
  int sweeps = 0;
  for (int i = 0; i < 12; ++i) {
    bridge_->publish("/scan", sweep_message(stamp_us(), {1.0, 2.0}));
    std::this_thread::sleep_for(30ms);
    const driving::Reading reading = driver_->read();
    if (!reading.scan) continue;
    ++sweeps;
    EXPECT_LE(reading.scan_t_ms.value(), silent_since_ms + 100) << "the agent stops as for any other silence";
  }
  EXPECT_GT(sweeps, 0);
}

TEST_F(RosbridgeDriverTest, RepeatedAndBlindSweepsAreNone) {
  ASSERT_TRUE(sweeps_come(4s));
  std::this_thread::sleep_for(100ms);
  driver_->read();
  const double infinity = std::numeric_limits<double>::infinity();
  bool seen = false;
  const std::int64_t repeated_us = stamp_us();
  for (int i = 0; i < 10; ++i) {
    bridge_->publish("/odom", odometry_message(stamp_us(), {}, 0.0));
    bridge_->publish("/scan", sweep_message(repeated_us, {1.0, 2.0}));
    std::this_thread::sleep_for(60ms);
    const bool sweep = driver_->read().scan.has_value();
    seen = seen || (i > 2 && sweep);  // the first of them is new
  }
  EXPECT_FALSE(seen) << "the same sweep again";
  for (int i = 0; i < 10; ++i) {
    bridge_->publish("/odom", odometry_message(stamp_us(), {}, 0.0));
    bridge_->publish("/scan", sweep_message(stamp_us(), {infinity, infinity}));
    std::this_thread::sleep_for(60ms);
    EXPECT_FALSE(driver_->read().scan);
  }
  EXPECT_TRUE(logged("saw nothing at all"));
}

TEST_F(RosbridgeDriverTest, OutlivesWhatIsNoMessage) {
  for (const std::string& text :
       {std::string("{"), std::string("[]"), std::string("{\"op\":\"publish\",\"topic\":\"/scan\",\"msg\":null}"),
        std::string(100'000, '['), std::string("{\"op\":\"status\",\"level\":\"error\",\"msg\":\"bad\\nnews\"}")}) {
    bridge_->send_raw(text);
  }
  EXPECT_TRUE(eventually([&] { return logged("of no use") && logged("bad?news"); }));
  EXPECT_TRUE(sweeps_come(4s));
  EXPECT_EQ(bridge_->connections(), 1);
}

TEST_F(RosbridgeDriverTest, EndsAConnectionWhoseMessageIsTooLarge) {
  bridge_->send_raw("{\"op\":\"" + std::string(kMaxRosMessageBytes + 1, 'a') + "\"}");
  EXPECT_TRUE(eventually([&] { return logged("larger than allowed") && bridge_->connections() == 2; }));
  driver_->command({});
  EXPECT_TRUE(sweeps_come(4s));
}

TEST_F(RosbridgeDriverTest, WaitsForARobotThatIsNotThere) {
  bridge_.reset();
  ASSERT_TRUE(eventually([&] { return logged("connection lost"); }));
  driver_->command({0.4, 0.0});
  EXPECT_FALSE(driver_->read().scan);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_FALSE(*driver_->next_picture(stop.get_token()));
}

TEST(RosbridgeFiles, AreRefusedWithWhatIsWrong) {
  const ScratchFolder folder;
  const auto log = [](const std::string&) {};
  EXPECT_EQ(make_rosbridge_driver("/nowhere/robot.json", log).error().code, ErrorCode::kNotFound);
  json robot = wire::rosbridge_to_json(sample_rosbridge());
  const std::string file = folder.put("robot.json", robot.dump()).string();
  const auto without_camera = make_rosbridge_driver(file, log);
  EXPECT_EQ(without_camera.error().code, ErrorCode::kNotFound);
  EXPECT_NE(without_camera.error().where.find("camera.json"), std::string::npos);
  robot["rider"] = {{"topic", "/cmd_vel"}, {"type", "geometry_msgs/Twist"}, {"motion", "own"}};
  folder.put("robot.json", robot.dump());
  const auto echo = make_rosbridge_driver(file, log);
  EXPECT_EQ(echo.error().code, ErrorCode::kInvalidInput);
  EXPECT_NE(echo.error().where.find("rider"), std::string::npos);
  robot.erase("rider");
  robot["address"] = "ws://robot:port";
  folder.put("robot.json", robot.dump());
  EXPECT_EQ(make_rosbridge_driver(file, log).error().where, "ws://robot:port");
}

}  // namespace
}  // namespace homeward::agent::rosbridge_driver_test
