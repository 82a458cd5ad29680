// SPDX-License-Identifier: Apache-2.0
#include "agent/drivers/link_lag.hpp"

#include <algorithm>
#include <cmath>

namespace homeward::agent {

driving::Milliseconds StampedDelay::age_ms(std::int64_t stamp_us, driving::Milliseconds now_ms) {
  const double delay_ms = static_cast<double>(now_ms) - 0.001 * static_cast<double>(stamp_us);
  if (quickest_ms_) *quickest_ms_ += most_drift_ * static_cast<double>(now_ms - at_ms_);
  quickest_ms_ = std::min(delay_ms, quickest_ms_.value_or(delay_ms));
  at_ms_ = now_ms;
  return std::llround(delay_ms - *quickest_ms_);
}

void LinkLag::begin(driving::Milliseconds now_ms) {
  begun_ms_ = now_ms;
  late_.clear();
  lags_since_ms_.reset();
  newest_from_ms_.reset();
}

void LinkLag::heard(driving::Milliseconds age_ms, driving::Milliseconds now_ms) {
  newest_from_ms_ = std::max(newest_from_ms_.value_or(now_ms - age_ms), now_ms - age_ms);
  note(age_ms, now_ms);
}

void LinkLag::pinged(driving::Milliseconds lag_ms, driving::Milliseconds now_ms) { note(lag_ms, now_ms); }

void LinkLag::note(driving::Milliseconds late_ms, driving::Milliseconds now_ms) {
  while (!late_.empty() && now_ms - late_.front().at_ms > config_.remembered_ms) late_.pop_front();
  if (late_.empty()) lags_since_ms_.reset();
  if (late_ms <= config_.most_ms) return;
  late_.push_back({now_ms, late_ms});
  if (!lags_since_ms_) lags_since_ms_ = now_ms;
}

driving::Milliseconds LinkLag::worst_ms(driving::Milliseconds now_ms) const {
  driving::Milliseconds worst_ms = 0;
  for (const Late& late : late_) {
    if (now_ms - late.at_ms <= config_.remembered_ms) worst_ms = std::max(worst_ms, late.by_ms);
  }
  return worst_ms;
}

bool LinkLag::late(driving::Milliseconds now_ms) const {
  return worst_ms(now_ms) > 0 || (newest_from_ms_ && now_ms - *newest_from_ms_ > config_.most_ms);
}

bool LinkLag::settled(driving::Milliseconds now_ms) const { return now_ms - begun_ms_ >= config_.remembered_ms; }

bool LinkLag::lost(driving::Milliseconds now_ms) const {
  return lags_since_ms_ && worst_ms(now_ms) > 0 && now_ms - *lags_since_ms_ > config_.lasts_ms;
}

}  // namespace homeward::agent
