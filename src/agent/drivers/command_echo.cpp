// SPDX-License-Identifier: Apache-2.0
#include "agent/drivers/command_echo.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace homeward::agent {
namespace {

constexpr double kSame = 1e-6;  // in m/s and rad/s; a bridge may write fewer digits than it was given

bool same(const driving::Motion& a, const driving::Motion& b) {
  return std::abs(a.speed_mps - b.speed_mps) < kSame && std::abs(a.turn_radps - b.turn_radps) < kSame;
}

}  // namespace

bool CommandEcho::sent(const driving::Motion& motion) {
  sent_.push_back(motion);
  if (sent_.size() > static_cast<std::size_t>(most_unheard_)) sent_.pop_front();
  if (++unheard_ < most_unheard_) return false;
  unheard_ = 0;
  missed_ = true;
  return true;
}

bool CommandEcho::heard(const driving::Motion& motion) {
  if (std::ranges::none_of(sent_, [&](const driving::Motion& other) { return same(motion, other); })) return false;
  unheard_ = 0;
  return std::exchange(missed_, false);
}

void CommandEcho::begin() {
  sent_.clear();
  unheard_ = 0;
}

}  // namespace homeward::agent
