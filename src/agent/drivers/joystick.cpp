// SPDX-License-Identifier: Apache-2.0
#include "agent/drivers/joystick.hpp"

#include <fcntl.h>
#include <linux/joystick.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <utility>

namespace homeward::agent {
namespace {

constexpr double kDeadZone = 0.15;  // of full deflection; springs and noise stay below it
constexpr double kFullDeflection = 32767.0;
constexpr driving::Milliseconds kTryAgain_ms = 1000;
constexpr driving::Milliseconds kHeld_ms =
    10'000;                        // without a message; a hand hardly keeps a stick so still, a dead battery does
constexpr int kMostEvents = 1000;  // at one time: no device says more between two cycles

static_assert(sizeof(js_event) == 8);

/// Beyond the dead zone, from 0 on.
double beyond_dead_zone(double axis) {
  const double beyond = std::max(0.0, std::abs(axis) - kDeadZone) / (1.0 - kDeadZone);
  return std::copysign(std::min(1.0, beyond), axis);
}

/// A descriptor, or -1 with errno.
int open_device(const std::string& device) { return ::open(device.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC); }

}  // namespace

Result<std::unique_ptr<Joystick>> Joystick::open(const std::string& device,
                                                 std::function<void(const std::string&)> log) {
  const int descriptor = open_device(device);
  if (descriptor < 0) {
    const ErrorCode code = errno == ENOENT || errno == ENODEV || errno == ENXIO ? ErrorCode::kNotFound : ErrorCode::kIo;
    return fail(code, std::string("The joystick cannot be opened: ") + std::strerror(errno) + ".", device);
  }
  struct stat about {};
  if (::fstat(descriptor, &about) != 0 || !(S_ISCHR(about.st_mode) || S_ISFIFO(about.st_mode))) {
    ::close(descriptor);
    return fail(ErrorCode::kInvalidInput, "A joystick is a device such as /dev/input/js0.", device);
  }
  return std::unique_ptr<Joystick>(new Joystick(device, descriptor, std::move(log)));
}

Joystick::Joystick(std::string device, int descriptor, std::function<void(const std::string&)> log)
    : device_(std::move(device)), log_(std::move(log)), descriptor_(descriptor) {}

Joystick::~Joystick() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::optional<driving::JoystickReading> Joystick::read(const driving::Body& body, driving::Milliseconds now_ms,
                                                       driving::Milliseconds said_ms) {
  if (descriptor_ < 0) {
    if (now_ms - tried_ms_ < kTryAgain_ms) return std::nullopt;
    tried_ms_ = now_ms;
    descriptor_ = open_device(device_);
    if (descriptor_ < 0) return std::nullopt;
  }
  if (!drain()) {
    forget(now_ms);
    return std::nullopt;
  }
  if (std::exchange(changed_, false) || !there_) changed_ms_ = now_ms;
  const double forward = -beyond_dead_zone(axes_[1]);
  const double left = -beyond_dead_zone(axes_[0]);
  const bool at_rest = forward == 0.0 && left == 0.0;
  // A touch that is over already counts too.
  driving::JoystickReading hand{said_ms, std::exchange(touched_, false) || !at_rest, {}};
  rested_ = rested_ || at_rest;
  if (!there_) {
    log_("the joystick " + device_ + (rested_ ? " is there" : " is there, but not at rest: release it"));
    there_ = true;
  }
  const bool doubted = rested_ && !at_rest && now_ms - changed_ms_ > kHeld_ms;
  if (doubted && !doubted_) log_("the joystick " + device_ + " has been deflected without a change for 10 s: move it");
  doubted_ = doubted;
  if (rested_ && !at_rest && !doubted) hand.wanted = {forward * body.max_speed_mps, left * body.max_turn_radps};
  return hand;
}

void Joystick::forget(driving::Milliseconds now_ms) {
  if (there_) log_("the joystick " + device_ + " is gone");
  ::close(descriptor_);
  descriptor_ = -1;
  tried_ms_ = now_ms;
  have_ = 0;
  axes_ = {};
  there_ = rested_ = touched_ = changed_ = doubted_ = false;
}

/// Takes what has come; false when the device is gone.
bool Joystick::drain() {
  for (int k = 0; k < kMostEvents; ++k) {
    const ssize_t got = ::read(descriptor_, event_.data() + have_, event_.size() - have_);
    if (got > 0) {
      have_ += static_cast<std::size_t>(got);
      if (have_ == event_.size()) take_event();
      continue;
    }
    if (got < 0 && errno == EINTR) continue;
    return got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK);
  }
  return true;
}

void Joystick::take_event() {
  js_event event{};
  std::memcpy(&event, event_.data(), sizeof event);
  have_ = 0;
  changed_ = true;
  // What stands when the device comes is sent as events marked as initial.
  if ((event.type & ~JS_EVENT_INIT) != JS_EVENT_AXIS || event.number >= axes_.size()) return;
  axes_[event.number] = std::clamp(event.value / kFullDeflection, -1.0, 1.0);
  touched_ = touched_ || beyond_dead_zone(axes_[event.number]) != 0.0;
}

}  // namespace homeward::agent
