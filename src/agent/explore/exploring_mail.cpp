// SPDX-License-Identifier: Apache-2.0
#include "agent/explore/exploring_mail.hpp"

#include <algorithm>
#include <cstdlib>

namespace homeward::agent {

std::vector<FromCompanion> take_from_companion(std::vector<wire::ServerMessage>& messages) {
  const auto now = std::chrono::steady_clock::now();
  std::vector<FromCompanion> told;
  std::erase_if(messages, [&](wire::ServerMessage& message) {
    if (auto* view = std::get_if<wire::CompanionView>(&message)) {
      told.push_back({std::move(*view), now});
    } else if (const auto* state = std::get_if<wire::CompanionState>(&message)) {
      told.push_back({*state, now});
    } else {
      return false;
    }
    return true;
  });
  return told;
}

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
