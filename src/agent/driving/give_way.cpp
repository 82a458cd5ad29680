// SPDX-License-Identifier: Apache-2.0
#include "agent/driving/give_way.hpp"

#include <algorithm>
#include <cmath>

namespace homeward::agent {
namespace {

constexpr double kSpacing_m = 0.1;  // of the trail
constexpr std::size_t kLongest = 100;
constexpr double kGotOn_m = 0.3;  // with less it has not got on, however it turned there
constexpr double kBack_m = 1.2;
constexpr double kLeastBack_m = 0.5;  // with less of a trail it stays
constexpr double kThere_m = 0.15;
constexpr std::int64_t kBacking_ms = 8000;  // at most
constexpr std::int64_t kWaiting_ms = 2500;
constexpr int kTimes = 3;
constexpr double kElsewhere_m = 2.0;  // from where it backed off: it has got past

Eigen::Vector2d position(const Pose2& pose) { return {pose.x_m, pose.y_m}; }

/// The newest point of the trail that is so far off, else the farthest; nothing where that is too near. By distance,
/// not along the trail: that leads to and fro where the robot has backed off before.
std::optional<Eigen::Vector2d> point_behind(const std::deque<Eigen::Vector2d>& trail_m, const Eigen::Vector2d& here_m) {
  Eigen::Vector2d behind_m = here_m;
  for (auto point = trail_m.rbegin(); point != trail_m.rend() && (behind_m - here_m).norm() < kBack_m; ++point) {
    if ((*point - here_m).norm() > (behind_m - here_m).norm()) behind_m = *point;
  }
  if ((behind_m - here_m).norm() < kLeastBack_m) return std::nullopt;
  return behind_m;
}

void enter(GiveWay& state, GiveWay::Phase phase, std::int64_t now_ms) {
  state.phase = phase;
  state.phase_since_ms = now_ms;
  state.still_at_m.reset();
}

bool has_stood(GiveWay& state, const Eigen::Vector2d& here_m, std::int64_t now_ms, std::int64_t patience_ms) {
  if (state.still_at_m && (*state.still_at_m - here_m).norm() <= kGotOn_m)
    return now_ms - state.still_since_ms >= patience_ms;
  state.still_at_m = here_m;
  state.still_since_ms = now_ms;
  return false;
}

}  // namespace

void remember_trail(GiveWay& state, const Pose2& odometry) {
  const Eigen::Vector2d here_m = position(odometry);
  if (!state.trail_m.empty() && (state.trail_m.back() - here_m).norm() < kSpacing_m) return;
  state.trail_m.push_back(here_m);
  if (state.trail_m.size() > kLongest) state.trail_m.pop_front();
}

std::optional<Eigen::Vector2d> give_way(GiveWay& state, const Pose2& odometry, std::int64_t now_ms,
                                        std::int64_t patience_ms) {
  const Eigen::Vector2d here_m = position(odometry);
  if (state.phase == GiveWay::Phase::kOnTheWay) {
    if ((here_m - state.blocked_at_m).norm() > kElsewhere_m) state.times = 0;
    if (!has_stood(state, here_m, now_ms, patience_ms) || state.times >= kTimes) return std::nullopt;
    const auto behind_m = point_behind(state.trail_m, here_m);
    if (!behind_m) return std::nullopt;
    if (state.times == 0) state.blocked_at_m = here_m;
    ++state.times;
    state.back_to_m = *behind_m;
    enter(state, GiveWay::Phase::kBacking, now_ms);
  }
  if (state.phase == GiveWay::Phase::kBacking) {
    const bool there = (state.back_to_m - here_m).norm() < kThere_m;
    if (!there && now_ms - state.phase_since_ms < kBacking_ms) {
      const Pose2 goal = inverse(odometry) * Pose2{state.back_to_m.x(), state.back_to_m.y(), 0.0};
      return Eigen::Vector2d(goal.x_m, goal.y_m);
    }
    enter(state, GiveWay::Phase::kWaiting, now_ms);
  }
  if (now_ms - state.phase_since_ms < kWaiting_ms) return Eigen::Vector2d(Eigen::Vector2d::Zero());
  enter(state, GiveWay::Phase::kOnTheWay, now_ms);
  return std::nullopt;
}

void forget_standing(GiveWay& state) {
  state.still_at_m.reset();
  state.phase = GiveWay::Phase::kOnTheWay;
}

void begin_way(GiveWay& state) {
  forget_standing(state);
  state.times = std::min(state.times, kTimes - 1);
}

}  // namespace homeward::agent
