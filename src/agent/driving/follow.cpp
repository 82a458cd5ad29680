// SPDX-License-Identifier: Apache-2.0
#include "agent/driving/follow.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace homeward::agent {
namespace {

struct Answer {
  int index = 0;
  homing::HomeVector vector;
};

bool is_sure(const homing::HomeVector& vector, const FollowConfig& config) {
  return vector.confidence >= config.sure && vector.inliers >= config.sure_inliers;
}

double distance_guess_m(const homing::HomeVector& vector, const FollowConfig& config) {
  return std::clamp(config.metres_per_parallax * vector.median_parallax_rad, 0.1, 4.0);
}

void remember(FollowState& state, const homing::HomeVector& vector, const Pose2& odometry, const FollowConfig& config) {
  const double distance_m = distance_guess_m(vector, config);
  state.goal_in_odom = odometry * Pose2{distance_m * std::cos(vector.bearing_rad), distance_m * std::sin(vector.bearing_rad),
                                        vector.turn_rad};
  state.seen_from = odometry;
  state.last_parallax_rad = vector.median_parallax_rad;
}

/// The view to home to: the present one, or a later one that is clearly seen once the present one is near or unseen.
std::optional<Answer> choose(const FollowState& state, const VisualPath& path, const features::Appearance& seen,
                             const FollowConfig& config, std::uint64_t seed) {
  const int last = static_cast<int>(path.views.size()) - 1;
  std::optional<Answer> best;
  for (int index = state.index; index <= std::min(last, state.index + config.look_ahead); ++index) {
    const auto vector = homing::home_vector(seen, path.views[static_cast<std::size_t>(index)], config.homing, seed);
    if (!vector || vector->confidence < config.believe) {
      if (best && is_sure(best->vector, config)) break;  // what lies behind an unseen view is not sought past a good one
      continue;
    }
    if (!best) {
      best = Answer{index, *vector};
      continue;
    }
    // The one before is passed, or near enough to cut the corner to this one.
    const bool passed = best->vector.median_parallax_rad < config.pass_parallax_rad;
    const bool behind = std::abs(best->vector.bearing_rad) > 0.55 * std::numbers::pi && is_sure(*vector, config) &&
                        best->vector.median_parallax_rad < config.skip_parallax_rad;
    const bool near = best->vector.median_parallax_rad < config.skip_parallax_rad && is_sure(*vector, config) &&
                      std::abs(vector->bearing_rad - best->vector.bearing_rad) < 0.6;
    if (!passed && !behind && !near) break;
    best = Answer{index, *vector};
  }
  return best;
}

}  // namespace

std::optional<Eigen::Vector2d> remembered_goal(const FollowState& state, const Pose2& odometry, const FollowConfig& config) {
  if (!state.goal_in_odom) return std::nullopt;
  const Pose2 moved = inverse(state.seen_from) * odometry;
  if (std::hypot(moved.x_m, moved.y_m) > config.remember_m) return std::nullopt;
  const Pose2 goal = inverse(odometry) * *state.goal_in_odom;
  return Eigen::Vector2d(goal.x_m, goal.y_m);
}

FollowResult follow(FollowState& state, const VisualPath& path, const features::Appearance& seen, const Pose2& odometry,
                    const FollowConfig& config, std::uint64_t seed) {
  FollowResult result;
  const int last = static_cast<int>(path.views.size()) - 1;
  const std::optional<Answer> answer = choose(state, path, seen, config, seed);
  if (!answer) {
    ++state.unanswered;
    result.goal_m = remembered_goal(state, odometry, config);
    result.blind = !result.goal_m;
    result.parallax_rad = state.last_parallax_rad;
    return result;
  }
  state.unanswered = 0;
  if (answer->index != state.index) {
    state.index = answer->index;
    state.least_parallax_rad = 1e9;
  }
  const homing::HomeVector& vector = answer->vector;
  remember(state, vector, odometry, config);
  result.vector = vector;
  result.parallax_rad = vector.median_parallax_rad;
  const double distance_m = distance_guess_m(vector, config);
  result.goal_m = Eigen::Vector2d(distance_m * std::cos(vector.bearing_rad), distance_m * std::sin(vector.bearing_rad));
  if (state.index == last) {
    state.least_parallax_rad = std::min(state.least_parallax_rad, vector.median_parallax_rad);
    const bool there = vector.median_parallax_rad < config.homing.arrived_parallax_rad;
    // Driven past it: it lies behind, and it had been near.
    const bool past = std::abs(vector.bearing_rad) > 0.5 * std::numbers::pi &&
                      state.least_parallax_rad < 2.5 * config.homing.arrived_parallax_rad &&
                      vector.median_parallax_rad < 4.0 * config.homing.arrived_parallax_rad;
    result.at_end = there || past;
    state.turn_at_end_rad = vector.turn_rad;
  }
  return result;
}

}  // namespace homeward::agent
