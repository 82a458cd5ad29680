// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

namespace homeward::driving {

/// How fast a robot turns, by its odometry: over a tenth of a second or so, as one step between two messages of it says
/// nothing.
/// A difference quotient over that time; ours.
class TurnRate {
 public:
  /// Where it heads now. A gap in time says nothing of how it turns.
  void observe(double heading_rad, std::int64_t now_ms);
  /// Counter-clockwise; 0 where that is not known.
  [[nodiscard]] double radps() const { return radps_; }

 private:
  double heading_rad_ = 0.0;
  std::optional<std::int64_t> at_ms_;
  double radps_ = 0.0;
};

}  // namespace homeward::driving
