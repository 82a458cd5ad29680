// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

#include "server/time/clock.hpp"

namespace homeward::testing {

/// Goes as the machine's clocks do, and ahead of them by what the test has let pass.
class MovedClock : public server::Clock {
 public:
  [[nodiscard]] server::SteadyTime steady() const override { return real_.steady() + ahead(); }
  [[nodiscard]] TimeUs wall_us() const override { return real_.wall_us() + ahead_us_.load(); }

  void pass(std::chrono::microseconds time) { ahead_us_ += time.count(); }

 private:
  [[nodiscard]] std::chrono::microseconds ahead() const { return std::chrono::microseconds(ahead_us_.load()); }

  server::SystemClock real_;
  std::atomic<std::int64_t> ahead_us_{0};
};

}  // namespace homeward::testing
