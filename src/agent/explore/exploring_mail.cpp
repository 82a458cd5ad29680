// SPDX-License-Identifier: Apache-2.0
#include "agent/explore/exploring_mail.hpp"

#include <algorithm>
#include <cstdlib>

namespace homeward::agent {

std::optional<RangeSweep> sweep_of_picture(const std::deque<Sensed>& sweeps, const driving::SeenPicture& picture) {
  constexpr driving::Milliseconds kTogether_ms = 250;
  const auto apart_ms = [&](const Sensed& sensed) { return std::abs(sensed.sensors_ms - picture.taken_ms); };
  const auto nearest = std::ranges::min_element(sweeps, {}, apart_ms);
  if (nearest == sweeps.end() || apart_ms(*nearest) > kTogether_ms) return std::nullopt;
  RangeSweep sweep = nearest->sweep;
  sweep.robot_from_scan = inverse(picture.odometry) * nearest->odometry * sweep.robot_from_scan;
  return sweep;
}

}  // namespace homeward::agent
