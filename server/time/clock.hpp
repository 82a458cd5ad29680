// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

#include "core/time.hpp"

namespace homeward::server {

using SteadyTime = std::chrono::steady_clock::time_point;

/// The time that the server goes by. Handed in, so that tests can let it pass. Callable from any thread.
class Clock {
 public:
  virtual ~Clock() = default;
  /// For how long something lasts: nobody sets it, and it means nothing outside of this process.
  [[nodiscard]] virtual SteadyTime steady() const = 0;
  /// Now, as it is written to files and messages: microseconds since 1970, by the machine's clock.
  [[nodiscard]] virtual TimeUs wall_us() const = 0;
};

/// The clocks of the machine.
class SystemClock : public Clock {
 public:
  [[nodiscard]] SteadyTime steady() const override { return std::chrono::steady_clock::now(); }
  [[nodiscard]] TimeUs wall_us() const override {
    const auto since_1970 = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::microseconds>(since_1970).count();
  }
};

/// The one that a server goes by unless another is handed in.
inline const Clock& system_clock() {
  static const SystemClock kClock;
  return kClock;
}

}  // namespace homeward::server
