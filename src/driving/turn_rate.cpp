// SPDX-License-Identifier: Apache-2.0
#include "driving/turn_rate.hpp"

#include "core/angles.hpp"

namespace homeward::driving {

void TurnRate::observe(double heading_rad, std::int64_t now_ms) {
  constexpr std::int64_t kWindow_ms = 80;
  constexpr std::int64_t kGap_ms = 500;
  const std::int64_t passed_ms = at_ms_ ? now_ms - *at_ms_ : 0;
  if (at_ms_ && passed_ms >= 0 && passed_ms < kWindow_ms) return;
  const bool known = at_ms_ && passed_ms > 0 && passed_ms <= kGap_ms;
  radps_ = known ? 1000.0 * wrap_angle(heading_rad - heading_rad_) / static_cast<double>(passed_ms) : 0.0;
  heading_rad_ = heading_rad;
  at_ms_ = now_ms;
}

}  // namespace homeward::driving
