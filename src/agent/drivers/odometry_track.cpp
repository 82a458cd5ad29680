// SPDX-License-Identifier: Apache-2.0
#include "agent/drivers/odometry_track.hpp"

#include <algorithm>

namespace homeward::agent {
namespace {

constexpr std::int64_t kKept_us = 3'000'000;
constexpr std::size_t kMostKept = 1000;
constexpr std::int64_t kOutside_us = 500'000;  // the next reading may still be on its way

}  // namespace

void OdometryTrack::add(std::optional<std::int64_t> stamp_us, const Pose2& pose) {
  newest_ = pose;
  if (!stamp_us) return;
  if (!stamped_.empty() && *stamp_us <= stamped_.back().stamp_us) stamped_.clear();
  stamped_.push_back({*stamp_us, pose});
  while (stamped_.size() > kMostKept || *stamp_us - stamped_.front().stamp_us > kKept_us) stamped_.pop_front();
}

Pose2 OdometryTrack::at(std::optional<std::int64_t> stamp_us) const {
  if (!stamp_us || stamped_.empty()) return newest_;
  if (*stamp_us < stamped_.front().stamp_us - kOutside_us || *stamp_us > stamped_.back().stamp_us + kOutside_us) {
    return newest_;
  }
  const auto after = std::lower_bound(stamped_.begin(), stamped_.end(), *stamp_us,
                                      [](const Stamped& reading, std::int64_t t) { return reading.stamp_us < t; });
  if (after == stamped_.begin()) return stamped_.front().pose;
  if (after == stamped_.end()) return stamped_.back().pose;
  const Stamped& before = *(after - 1);
  const double share =
      static_cast<double>(*stamp_us - before.stamp_us) / static_cast<double>(after->stamp_us - before.stamp_us);
  const Pose2& a = before.pose;
  const Pose2& b = after->pose;
  return {a.x_m + share * (b.x_m - a.x_m), a.y_m + share * (b.y_m - a.y_m),
          wrap_angle(a.theta_rad + share * wrap_angle(b.theta_rad - a.theta_rad))};
}

}  // namespace homeward::agent
