// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

#include "server/time/clock.hpp"

namespace homeward::testing {

/// Goes as the machine's clocks do, and ahead of them by what the test has let pass; once it stands, what lasts goes on
/// by that alone, however slow the machine is.
class MovedClock : public server::Clock {
 public:
  [[nodiscard]] server::SteadyTime steady() const override {
    const std::int64_t stood_at_us = stood_at_us_.load();
    const auto real =
        stood_at_us == kGoes ? real_.steady() : server::SteadyTime(std::chrono::microseconds(stood_at_us));
    return real + std::chrono::microseconds(ahead_us_.load());
  }
  /// Goes on by itself always: what is written in the order of time is read in it.
  [[nodiscard]] TimeUs wall_us() const override { return real_.wall_us() + ahead_us_.load(); }

  void pass(std::chrono::microseconds time) { ahead_us_ += time.count(); }
  /// From now on steady() is moved by pass() alone.
  void stand() {
    stood_at_us_ = std::chrono::duration_cast<std::chrono::microseconds>(real_.steady().time_since_epoch()).count();
  }

 private:
  static constexpr std::int64_t kGoes = -1;  // before the machine was started

  server::SystemClock real_;
  std::atomic<std::int64_t> ahead_us_{0};
  std::atomic<std::int64_t> stood_at_us_{kGoes};
};

}  // namespace homeward::testing
