// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/result.hpp"
#include "driving/inputs.hpp"

namespace homeward::agent {

/// A joystick of Linux's joystick interface (Documentation/input/joydev/joystick-api.rst of the kernel): axis 1 drives,
/// forward is up, axis 0 turns. It may be unplugged and plugged in again at any time.
class Joystick {
 public:
  /// `log` gets a line when it comes or goes. Errors: kNotFound, kIo (it may not be read), kInvalidInput (neither a
  /// device nor a pipe).
  static Result<std::unique_ptr<Joystick>> open(const std::string& device, std::function<void(const std::string&)> log);
  ~Joystick();
  Joystick(const Joystick&) = delete;
  Joystick& operator=(const Joystick&) = delete;

  /// What it says now, full deflection being the body's greatest speed; nothing while it is not there. Never waits.
  /// `now_ms`: by a clock that never jumps, for looking whether it is back; `said_ms`: what the hand is stamped with.
  /// One that is deflected when it comes wants no motion until it has been at rest once: it may lie on its side. Nor
  /// does one that has been deflected for 10 s without a message: a device tells of changes only, and so does a
  /// wireless one whose battery died under the rider's hand.
  std::optional<driving::JoystickReading> read(const driving::Body& body, driving::Milliseconds now_ms,
                                               driving::Milliseconds said_ms);

 private:
  Joystick(std::string device, int descriptor, std::function<void(const std::string&)> log);
  bool drain();
  void forget(driving::Milliseconds now_ms);
  void take_event();

  std::string device_;
  std::function<void(const std::string&)> log_;
  int descriptor_ = -1;
  driving::Milliseconds tried_ms_ = 0;
  std::array<std::uint8_t, 8> event_{};  // as much of one as has come
  std::size_t have_ = 0;
  std::array<double, 2> axes_{};          // -1..1
  bool there_ = false;                    // and that was logged
  bool touched_ = false;                  // deflected at some moment since the last reading
  bool changed_ = false;                  // since the last reading
  driving::Milliseconds changed_ms_ = 0;  // when it last sent a change
  bool doubted_ = false;                  // it has been deflected for too long, and that was logged
  bool rested_ = false;                   // it has been at rest since it came
};

}  // namespace homeward::agent
