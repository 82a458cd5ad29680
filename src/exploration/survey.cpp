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

void Survey::choose(const Pose2& odometry, std::int64_t now_ms) {
  chosen_ms_ = now_ms;
  const Reach reach = explorer_.reach(odometry);
  const auto next = explorer_.next(reach, target_m_);
  complete_ = !next;
  target_m_.reset();
  goal_m_.reset();
  if (!next) return;
  target_m_ = next->at_m;
  const std::vector<Eigen::Vector2d> way_m = reach.way_m(next->cell);
  const Eigen::Vector2d from_m = position_m(explorer_.floor_from_robot(odometry));
  goal_m_ = goal_on(reach, way_m, from_m, config_.ahead_m);
}

SurveyStep Survey::go_on(const RangeSweep& sweep, const Pose2& odometry, bool blocked, std::int64_t now_ms) {
  explorer_.see(sweep, odometry);
  SurveyStep step;
  if (explorer_.wants_picture(odometry)) {
    step.takes_picture = true;
    chosen_ms_.reset();
  }
  if (at_target(odometry)) {
    // What it came for has been seen by now, or cannot be seen.
    step.takes_picture = step.takes_picture || explorer_.since_picture_m(odometry) >= config_.least_between_m;
    explorer_.give_up(*target_m_);
    target_m_.reset();
    goal_m_.reset();
    chosen_ms_.reset();
  } else if (blocked && target_m_) {
    explorer_.give_up(*target_m_);
    target_m_.reset();
    chosen_ms_.reset();
  }
  if (step.takes_picture && explorer_.views().empty()) return step;
  if (!chosen_ms_ || now_ms - *chosen_ms_ >= config_.chosen_every_ms) choose(odometry, now_ms);
  if (goal_m_) {
    const Pose2 odometry_from_floor = odometry * inverse(explorer_.floor_from_robot(odometry));
    step.goal_m = position_m(odometry_from_floor * Pose2{goal_m_->x(), goal_m_->y(), 0.0});
  }
  step.complete = complete_ && !step.takes_picture;
  return step;
}

void Survey::take(const RangeSweep& sweep, const Pose2& odometry,
                  std::shared_ptr<const features::Appearance> appearance) {
  explorer_.take(sweep, odometry, std::move(appearance));
  chosen_ms_.reset();
}

}  // namespace homeward::exploration
