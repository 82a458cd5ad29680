// SPDX-License-Identifier: Apache-2.0
#include "driving/give_way.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace homeward::driving {
namespace {

constexpr double kSpacing_m = 0.1;     // of the trail
constexpr std::size_t kLongest = 300;  // points of it: to and fro before somebody a few times

/// The newest point of the trail that is so far off, else the farthest; nothing where that is too near. By distance,
/// not along the trail: that leads to and fro where the robot has backed off before.
std::optional<Eigen::Vector2d> point_behind(const std::deque<Eigen::Vector2d>& trail_m, const Eigen::Vector2d& here_m,
                                            double distance_m, double least_m) {
  Eigen::Vector2d behind_m = here_m;
  for (auto point = trail_m.rbegin(); point != trail_m.rend() && (behind_m - here_m).norm() < distance_m; ++point) {
    if ((*point - here_m).norm() > (behind_m - here_m).norm()) behind_m = *point;
  }
  if ((behind_m - here_m).norm() < least_m) return std::nullopt;
  return behind_m;
}

/// How far it is from a point to the nearest thing in a direction, in a lane as wide as the body.
double free_along_m(std::span<const Eigen::Vector2d> points_m, const Eigen::Vector2d& from_m,
                    const Eigen::Vector2d& direction, double half_width_m) {
  constexpr double kFarthest_m = 3.0;
  double free_m = kFarthest_m;
  for (const Eigen::Vector2d& point : points_m) {
    const Eigen::Vector2d off_m = point - from_m;
    const double along_m = off_m.dot(direction);
    const double across_m = direction.x() * off_m.y() - direction.y() * off_m.x();
    if (along_m > 0.0 && std::abs(across_m) < half_width_m) free_m = std::min(free_m, along_m);
  }
  return free_m;
}

/// Beside a point to which it backs off, robot frame: where most room is left on one side for somebody to pass.
Eigen::Vector2d pulled_over(const Body& body, std::span<const Eigen::Vector2d> points_m,
                            const Eigen::Vector2d& behind_m, const GiveWayConfig& config) {
  constexpr double kStep_m = 0.05;
  const double radius_m = body.outline.radius_m;
  const Eigen::Vector2d ahead = -behind_m.normalized();
  const Eigen::Vector2d left(-ahead.y(), ahead.x());
  const double left_m = free_along_m(points_m, behind_m, left, radius_m);
  const double right_m = free_along_m(points_m, behind_m, -left, radius_m);
  if (std::max(left_m, right_m) > config.enough_beside_m) return behind_m;
  const Eigen::Vector2d aside = left_m < right_m ? left : Eigen::Vector2d(-left);
  Eigen::Vector2d best_m = behind_m;
  for (double shift_m = kStep_m; shift_m < config.most_aside_m; shift_m += kStep_m) {
    const Eigen::Vector2d there_m = behind_m + shift_m * aside;
    const bool room = std::ranges::all_of(
        points_m, [&](const Eigen::Vector2d& point) { return (point - there_m).norm() >= radius_m + config.wall_m; });
    if (!room) break;
    best_m = there_m;
  }
  return best_m;
}

void enter(GiveWay& state, GiveWay::Phase phase, std::int64_t now_ms) {
  state.phase = phase;
  state.phase_since_ms = now_ms;
  state.still_at_m.reset();
}

bool has_stood(GiveWay& state, const Eigen::Vector2d& here_m, std::int64_t now_ms, std::int64_t patience_ms,
               double got_on_m) {
  if (state.still_at_m && (*state.still_at_m - here_m).norm() <= got_on_m)
    return now_ms - state.still_since_ms >= patience_ms;
  state.still_at_m = here_m;
  state.still_since_ms = now_ms;
  return false;
}

}  // namespace

void remember_trail(GiveWay& state, const Pose2& odometry) {
  const Eigen::Vector2d here_m = position_m(odometry);
  if (!state.trail_m.empty() && (state.trail_m.back() - here_m).norm() < kSpacing_m) return;
  state.trail_m.push_back(here_m);
  if (state.trail_m.size() > kLongest) state.trail_m.pop_front();
}

std::optional<Eigen::Vector2d> give_way(GiveWay& state, const Body& body, const Surroundings& about,
                                        const Pose2& odometry, std::int64_t now_ms, std::int64_t patience_ms,
                                        const GiveWayConfig& config) {
  const Eigen::Vector2d here_m = position_m(odometry);
  const auto quiet_for = [&](std::int64_t ms) {
    return !about.obstacle_moved_ms || now_ms - *about.obstacle_moved_ms >= ms;
  };
  if (state.phase == GiveWay::Phase::kOnTheWay) {
    const double backed_m = (state.back_to_m - state.blocked_at_m).norm();
    if ((here_m - state.blocked_at_m).norm() > std::max(config.elsewhere_m, backed_m + config.there_m)) state.times = 0;
    const bool somebody = !quiet_for(config.somebody_ms);
    if (!has_stood(state, here_m, now_ms, patience_ms, config.got_on_m) || (state.times >= config.times && !somebody))
      return std::nullopt;
    const double back_m = somebody
                              ? std::min(config.farthest_back_m, config.back_m + state.times * config.farther_back_m)
                              : config.back_m;
    const auto behind_m = point_behind(state.trail_m, here_m, back_m, config.least_back_m);
    if (!behind_m) return std::nullopt;
    if (state.times == 0) state.blocked_at_m = here_m;
    ++state.times;
    state.back_to_m = *behind_m;
    if (somebody && is_round(body.outline)) {
      const Eigen::Rotation2Dd turned(odometry.theta_rad);
      state.back_to_m =
          here_m + turned * pulled_over(body, about.points_m, turned.inverse() * (*behind_m - here_m), config);
    }
    state.backing_ms =
        config.turning_ms + static_cast<std::int64_t>(1000.0 * (state.back_to_m - here_m).norm() / config.backing_mps);
    enter(state, GiveWay::Phase::kBacking, now_ms);
  }
  if (state.phase == GiveWay::Phase::kBacking) {
    const bool there = (state.back_to_m - here_m).norm() < config.there_m;
    if (!there && now_ms - state.phase_since_ms < state.backing_ms) {
      const Pose2 goal = inverse(odometry) * Pose2{state.back_to_m.x(), state.back_to_m.y(), 0.0};
      return Eigen::Vector2d(goal.x_m, goal.y_m);
    }
    enter(state, GiveWay::Phase::kWaiting, now_ms);
  }
  const std::int64_t waited_ms = now_ms - state.phase_since_ms;
  if (waited_ms < config.waiting_ms || (!quiet_for(config.quiet_ms) && waited_ms < config.longest_wait_ms)) {
    return Eigen::Vector2d(Eigen::Vector2d::Zero());
  }
  enter(state, GiveWay::Phase::kOnTheWay, now_ms);
  return std::nullopt;
}

void forget_standing(GiveWay& state) {
  state.still_at_m.reset();
  state.phase = GiveWay::Phase::kOnTheWay;
}

void begin_way(GiveWay& state, const GiveWayConfig& config) {
  forget_standing(state);
  state.times = std::min(state.times, config.times - 1);
}

}  // namespace homeward::driving
