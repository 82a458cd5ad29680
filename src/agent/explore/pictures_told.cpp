// SPDX-License-Identifier: Apache-2.0
#include "agent/explore/pictures_told.hpp"

#include <algorithm>

namespace homeward::agent {

void PicturesTold::heard(std::int64_t has, std::int64_t now_ms) {
  const bool lost_some = has_ && has < *has_;  // it began anew
  if (has != has_) arrived_ms_ = now_ms;
  has_ = has;
  next_ = lost_some ? has : std::max(next_, has);
}

std::optional<std::int64_t> PicturesTold::next(std::int64_t pictures, std::int64_t now_ms) {
  if (!has_) return std::nullopt;
  if (next_ > *has_ && now_ms - arrived_ms_ >= config_.again_ms) {
    next_ = *has_;
    arrived_ms_ = now_ms;
  }
  if (next_ >= std::min(pictures, *has_ + config_.beyond)) return std::nullopt;
  if (told_ms_ && now_ms - *told_ms_ < config_.apart_ms) return std::nullopt;
  if (next_ == *has_) arrived_ms_ = now_ms;
  told_ms_ = now_ms;
  return next_++;
}

}  // namespace homeward::agent
