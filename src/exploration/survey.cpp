// SPDX-License-Identifier: Apache-2.0
#include "exploration/survey.hpp"

#include <cmath>
#include <utility>
#include <vector>

namespace homeward::exploration {
namespace {

/// Whether the body gets straight from one point to the other.
bool straight(const Reach& reach, const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m) {
  const double distance_m = (to_m - from_m).norm();
  const int steps = std::max(1, static_cast<int>(std::ceil(distance_m / reach.frame().cell_m)));
  for (int i = 1; i <= steps; ++i) {
    const FloorCell cell = reach.frame().cell(from_m + (to_m - from_m) * i / steps);
    if (!reach.frame().holds(cell) || !reach.reaches(reach.frame().index(cell))) return false;
  }
  return true;
}

/// The farthest point of a way that lies straight ahead, but not too far.
Eigen::Vector2d goal_on(const Reach& reach, const std::vector<Eigen::Vector2d>& way_m, const Eigen::Vector2d& from_m,
                        double ahead_m) {
  Eigen::Vector2d goal_m = way_m.front();
  for (const Eigen::Vector2d& point_m : way_m) {
    if ((point_m - from_m).norm() > ahead_m || !straight(reach, from_m, point_m)) break;
    goal_m = point_m;
  }
  return goal_m;
}

}  // namespace

bool Survey::at_target(const Pose2& odometry) const {
  return target_m_ && (position_m(explorer_.floor_from_robot(odometry)) - *target_m_).norm() <= config_.there_m;
}

void Survey::fence_off(std::vector<Eigen::Vector2d> corners_m) {
  explorer_.fence_off(std::move(corners_m));
  target_m_.reset();
  goal_m_.reset();
  chosen_ms_.reset();
}

/// Along the way to a cell, as far as that is straight.
void Survey::drive_on(const Reach& reach, std::size_t cell, const Pose2& odometry) {
  const std::vector<Eigen::Vector2d> way_m = reach.way_m(cell);
  if (way_m.empty()) return;
  const Eigen::Vector2d from_m = position_m(explorer_.floor_from_robot(odometry));
  goal_m_ = goal_on(reach, way_m, from_m, config_.ahead_m);
}

/// Whether it has to go home now, and the way there.
void Survey::turn_home_in_time(const Reach& reach, const Pose2& odometry, std::int64_t now_ms) {
  const auto home = reach.nearest(position_m(explorer_.poses().front()));
  if (!home) return;
  const double way_s = reach.cost_m(*home) / config_.home_mps;
  const auto needs_ms = static_cast<std::int64_t>(1000.0 * way_s) + config_.home_spare_ms;
  goes_home_ = goes_home_ || (back_by_ms_ && now_ms + needs_ms >= *back_by_ms_);
  if (!goes_home_) return;
  target_m_ = reach.frame().centre_m(reach.frame().cell_at(*home));
  drive_on(reach, *home, odometry);
}

void Survey::choose(const Pose2& odometry, std::int64_t now_ms) {
  chosen_ms_ = now_ms;
  const Reach reach = explorer_.reach(odometry);
  goal_m_.reset();
  turn_home_in_time(reach, odometry, now_ms);
  if (goes_home_) return;
  auto next = explorer_.next(reach, target_m_);
  if (!next && tried_ < config_.tries && explorer_.try_blocked_again()) {
    ++tried_;
    next = explorer_.next(reach, std::nullopt);
  }
  target_m_.reset();
  if (!next) {
    ended_ = SurveyEnd::kAllSeen;
    return;
  }
  ended_.reset();
  target_m_ = next->at_m;
  drive_on(reach, next->cell, odometry);
}

/// Whatever it tries, it stays where it is: to call that explored would be wrong.
void Survey::note_blocked(const Pose2& odometry) {
  const bool same_spot = position_m(inverse(blocked_at_) * odometry).norm() < config_.spot_m;
  blocked_in_a_row_ = same_spot ? blocked_in_a_row_ + 1 : 1;
  if (!same_spot) blocked_at_ = odometry;
  if (blocked_in_a_row_ >= config_.stuck_after) ended_ = SurveyEnd::kStuck;
}

/// The place is reached, or cannot be.
void Survey::leave_target(bool blocked, const Pose2& odometry) {
  if (blocked) note_blocked(odometry);
  if (goes_home_) {
    if (!blocked) ended_ = SurveyEnd::kBack;
    return;
  }
  // What it came for has been seen by now, or cannot be seen; a way may be free again later.
  if (blocked) {
    explorer_.put_off(*target_m_);
  } else {
    explorer_.give_up(*target_m_);
  }
  target_m_.reset();
  goal_m_.reset();
  chosen_ms_.reset();
}

SurveyStep Survey::go_on(const RangeSweep& sweep, const Pose2& odometry, bool blocked, std::int64_t now_ms) {
  explorer_.see(sweep, odometry);
  SurveyStep step;
  step.takes_picture = explorer_.wants_picture(odometry);
  if (step.takes_picture) chosen_ms_.reset();
  const bool reached = at_target(odometry);
  if (reached && explorer_.since_picture_m(odometry) >= config_.least_between_m) step.takes_picture = true;
  if (reached || (blocked && target_m_)) leave_target(!reached, odometry);
  if (step.takes_picture && explorer_.views().empty()) return step;
  const bool over = ended_ == SurveyEnd::kBack || ended_ == SurveyEnd::kStuck;
  if (!over && (!chosen_ms_ || now_ms - *chosen_ms_ >= config_.chosen_every_ms)) choose(odometry, now_ms);
  if (!step.takes_picture) step.ended = ended_;
  if (goal_m_ && !step.ended) {
    const Pose2 odometry_from_floor = odometry * inverse(explorer_.floor_from_robot(odometry));
    step.goal_m = position_m(odometry_from_floor * Pose2{goal_m_->x(), goal_m_->y(), 0.0});
  }
  return step;
}

void Survey::take(const RangeSweep& sweep, const Pose2& odometry,
                  std::shared_ptr<const features::Appearance> appearance) {
  explorer_.take(sweep, odometry, std::move(appearance));
  chosen_ms_.reset();
}

}  // namespace homeward::exploration
