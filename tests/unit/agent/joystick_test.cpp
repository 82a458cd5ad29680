// SPDX-License-Identifier: Apache-2.0
#include "agent/drivers/joystick.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/joystick.h>
#include <sys/stat.h>
#include <unistd.h>

#include "support/scratch_folder.hpp"

namespace homeward::agent::joystick_test {
namespace {

using ::testing::HasSubstr;

/// A pipe of that name takes the device's place: what a device tells, the test writes.
class JoystickTest : public ::testing::Test {
 protected:
  JoystickTest() : device_((folder_.path() / "js0").string()) {
    EXPECT_EQ(::mkfifo(device_.c_str(), 0600), 0);
    plug_in();
    body_.max_speed_mps = 0.5;
    body_.max_turn_radps = 1.0;
  }
  ~JoystickTest() override { unplug(); }

  void plug_in() { writer_ = ::open(device_.c_str(), O_RDWR | O_NONBLOCK); }
  void unplug() {
    if (writer_ >= 0) ::close(writer_);
    writer_ = -1;
  }
  void open() {
    auto opened = Joystick::open(device_, [this](const std::string& what) { log_ += what + "\n"; });
    ASSERT_TRUE(opened) << opened.error().message;
    joystick_ = std::move(*opened);
  }
  void say(int type, int number, int value) const {
    const js_event event{7, static_cast<__s16>(value), static_cast<__u8>(type), static_cast<__u8>(number)};
    ASSERT_EQ(::write(writer_, &event, sizeof event), static_cast<ssize_t>(sizeof event));
  }
  void push(int axis, int value) const { say(JS_EVENT_AXIS, axis, value); }
  std::optional<driving::JoystickReading> read() {
    now_ms_ += 40;
    return joystick_->read(body_, now_ms_, 5);
  }
  /// What must be there.
  driving::JoystickReading hand() {
    const auto said = read();
    EXPECT_TRUE(said);
    return said.value_or(driving::JoystickReading{});
  }

  homeward::testing::ScratchFolder folder_;
  std::string device_;
  std::unique_ptr<Joystick> joystick_;
  driving::Body body_;
  std::string log_;
  driving::Milliseconds now_ms_ = 10'000;
  int writer_ = -1;
};

TEST_F(JoystickTest, FullDeflectionIsTheBodysGreatestSpeed) {
  open();
  EXPECT_FALSE(hand().deflected);
  push(1, -32767);  // up
  push(0, 32767);   // to the right
  const driving::JoystickReading said = hand();
  EXPECT_TRUE(said.deflected);
  EXPECT_EQ(said.said_ms, 5);
  EXPECT_DOUBLE_EQ(said.wanted.speed_mps, 0.5);
  EXPECT_DOUBLE_EQ(said.wanted.turn_radps, -1.0);
}

TEST_F(JoystickTest, AHeldOneSaysSoAtEachReadingAndAReleasedOneIsAtRest) {
  open();
  read();
  push(1, 20000);
  const driving::JoystickReading said = hand();
  EXPECT_LT(said.wanted.speed_mps, -0.2);
  EXPECT_GT(said.wanted.speed_mps, -0.4);
  for (int k = 0; k < 20; ++k) EXPECT_TRUE(hand().deflected);  // no further event comes
  push(1, 0);
  EXPECT_FALSE(hand().deflected);
  EXPECT_DOUBLE_EQ(hand().wanted.speed_mps, 0.0);
}

TEST_F(JoystickTest, HeldForTenSecondsWithoutAWordItWantsNoMotionUntilItIsMoved) {
  open();
  read();
  push(1, -20000);
  EXPECT_GT(hand().wanted.speed_mps, 0.2);
  now_ms_ += 9'000;
  EXPECT_GT(hand().wanted.speed_mps, 0.2);
  now_ms_ += 1'000;
  const driving::JoystickReading said = hand();
  EXPECT_TRUE(said.deflected) << "no mission sets off under a hand, or under a dead battery";
  EXPECT_DOUBLE_EQ(said.wanted.speed_mps, 0.0);
  EXPECT_THAT(log_, HasSubstr("move it"));
  push(1, -20001);
  EXPECT_GT(hand().wanted.speed_mps, 0.2);
}

TEST_F(JoystickTest, ATouchBetweenTwoReadingsIsNotMissed) {
  open();
  read();
  push(0, 20000);
  push(0, 0);
  const driving::JoystickReading said = hand();
  EXPECT_TRUE(said.deflected);
  EXPECT_DOUBLE_EQ(said.wanted.turn_radps, 0.0);
  EXPECT_FALSE(hand().deflected);
}

TEST_F(JoystickTest, NoiseAroundItsRestIsNoHand) {
  open();
  for (const int value : {4000, -4000, 300, 4900}) {
    push(0, value);
    push(1, -value);
    EXPECT_FALSE(hand().deflected) << value;
  }
  push(0, -5400);
  EXPECT_TRUE(hand().deflected);
  EXPECT_GT(hand().wanted.turn_radps, 0.0);
  EXPECT_LT(hand().wanted.turn_radps, 0.05)
      << "the motion begins at the end of the dead zone, not at a sixth of it all";
}

TEST_F(JoystickTest, ButtonsAndOtherAxesAreNoHand) {
  open();
  say(JS_EVENT_BUTTON, 0, 1);
  say(JS_EVENT_BUTTON, 1, 1);
  push(2, 32767);
  push(7, -32767);
  EXPECT_FALSE(hand().deflected);
}

TEST_F(JoystickTest, DeflectedWhenItComesItEndsMissionsButWantsNoMotionUntilItWasAtRest) {
  say(JS_EVENT_AXIS | JS_EVENT_INIT, 0, 0);
  say(JS_EVENT_AXIS | JS_EVENT_INIT, 1, -30000);
  open();
  EXPECT_TRUE(hand().deflected);
  EXPECT_DOUBLE_EQ(hand().wanted.speed_mps, 0.0);
  EXPECT_THAT(log_, HasSubstr("release it"));
  push(1, 0);
  EXPECT_FALSE(hand().deflected);
  push(1, -30000);
  EXPECT_GT(hand().wanted.speed_mps, 0.3);
}

TEST_F(JoystickTest, UnpluggedItIsReleasedAndIsFoundAgain) {
  open();
  read();
  push(1, -32767);
  EXPECT_TRUE(hand().deflected);
  unplug();
  EXPECT_FALSE(read());
  EXPECT_THAT(log_, HasSubstr("gone"));
  for (int k = 0; k < 60; ++k) EXPECT_FALSE(read());  // it looks for it meanwhile
  plug_in();
  for (int k = 0; k < 30; ++k) read();
  EXPECT_FALSE(hand().deflected) << "what it said before it was unplugged is forgotten";
  push(1, -32767);
  EXPECT_DOUBLE_EQ(hand().wanted.speed_mps, 0.5);
}

TEST_F(JoystickTest, AnEventInTwoPiecesIsOne) {
  open();
  read();
  const js_event event{7, -32767, JS_EVENT_AXIS, 1};
  const auto* bytes = reinterpret_cast<const char*>(&event);
  ASSERT_EQ(::write(writer_, bytes, 5), 5);
  EXPECT_FALSE(hand().deflected);
  ASSERT_EQ(::write(writer_, bytes + 5, 3), 3);
  EXPECT_TRUE(hand().deflected);
}

TEST_F(JoystickTest, OneThatIsNotThereAtTheStartIsAnError) {
  const auto none = Joystick::open("/dev/input/no_such_joystick", [](const std::string&) {});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kNotFound);
  folder_.put("file", "no device");
  const auto file = Joystick::open((folder_.path() / "file").string(), [](const std::string&) {});
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().code, ErrorCode::kInvalidInput);
}

}  // namespace
}  // namespace homeward::agent::joystick_test
