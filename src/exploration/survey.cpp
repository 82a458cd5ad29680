// SPDX-License-Identifier: Apache-2.0
#include "exploration/survey.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "exploration/picture_rows.hpp"

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

/// The farthest point of a way that lies straight ahead, but not too far; nearer points than `least_m` are no goals.
Eigen::Vector2d goal_on(const Reach& reach, const std::vector<Eigen::Vector2d>& way_m, const Eigen::Vector2d& from_m,
                        double least_m, double ahead_m) {
  Eigen::Vector2d goal_m = way_m.back();
  bool found = false;
  for (const Eigen::Vector2d& point_m : way_m) {
    const double distance_m = (point_m - from_m).norm();
    if (distance_m < least_m) continue;
    if (found && (distance_m > ahead_m || !straight(reach, from_m, point_m))) break;
    goal_m = point_m;
    found = true;
  }
  return goal_m;
}

}  // namespace

bool Survey::at_target(const Pose2& odometry) const {
  return target_m_ && (position_m(explorer_.floor_from_robot(odometry)) - *target_m_).norm() <= config_.there_m;
}

SurveyRow Survey::row_of(SurveyState state, const Pose2& odometry) const {
  SurveyRow row;
  row.state = state;
  if (!explorer_.views().empty()) {
    row.picture = static_cast<int>(explorer_.views().size()) - 1;
    row.floor_from_robot = explorer_.floor_from_robot(odometry);
  }
  return row;
}

void Survey::note_place(SurveyState state, const Pose2& odometry) {
  rows_.push_back(row_of(state, odometry));
  rows_.back().place_m = target_m_;
}

/// Where that is another place than the one driven to before.
void Survey::note_next(const NextView& next, const std::optional<Eigen::Vector2d>& before_m, const Pose2& odometry) {
  if (before_m && (*before_m - *target_m_).norm() < explorer_.floor().frame().cell_m) return;
  note_place(SurveyState::kNextPlace, odometry);
  rows_.back().gain_m2 = next.gain_m2;
  rows_.back().cost_m = next.cost_m;
}

/// Once, however often it is asked what to do then.
void Survey::note_end(const Pose2& odometry) {
  if (std::exchange(end_noted_, true)) return;
  rows_.push_back(row_of(SurveyState::kEnded, odometry));
  rows_.back().end = ended_;
}

void Survey::forget_target() {
  target_m_.reset();
  goal_m_.reset();
  chosen_ms_.reset();
}

void Survey::set_fences(std::vector<std::vector<Eigen::Vector2d>> fences_m) {
  explorer_.set_fences(std::move(fences_m));
  forget_target();
}

void Survey::go_on_anew(const std::optional<Pose2>& odometry_moved) {
  if (odometry_moved) explorer_.move_odometry(*odometry_moved);
  explorer_.try_blocked_again();
  forget_target();
  goes_home_ = all_seen_ = false;
  waiting_since_ms_.reset();
  tried_ = blocked_in_a_row_ = 0;
  ended_.reset();
  end_noted_ = false;
}

CompanionReport Survey::report(const Pose2& odometry) const {
  return {shared_floor(explorer_.floor(), explorer_.coverage()), explorer_.floor_from_robot(odometry), target_m_,
          !ended_};
}

void Survey::end_at_limit(const Pose2& odometry) {
  ended_ = SurveyEnd::kLimit;
  note_end(odometry);
}

/// Along the way to a cell, as far as that is straight.
void Survey::drive_on(const Reach& reach, std::size_t cell, const Pose2& odometry) {
  target_m_ = reach.frame().centre_m(reach.frame().cell_at(cell));
  const std::vector<Eigen::Vector2d> way_m = reach.way_m(cell);
  if (way_m.empty()) return;
  const Eigen::Vector2d from_m = position_m(explorer_.floor_from_robot(odometry));
  goal_m_ = goal_on(reach, way_m, from_m, config_.there_m, config_.ahead_m);
}

/// Whether it has to go home now. Where no way home is known, it goes on until its time is over.
bool Survey::is_time_to_go_home(const Reach& reach, std::int64_t now_ms) const {
  if (!back_by_ms_) return false;
  const auto home = reach.nearest(position_m(explorer_.poses().front()));
  const double way_s = home ? reach.cost_m(*home) / config_.home_mps : 0.0;
  return now_ms + static_cast<std::int64_t>(1000.0 * way_s) + config_.home_spare_ms >= *back_by_ms_;
}

void Survey::go_home(const Reach& reach, const Pose2& odometry) {
  const bool turns_home = !std::exchange(goes_home_, true);
  target_m_.reset();
  const auto home = reach.nearest(position_m(explorer_.poses().front()));
  if (home) {
    drive_on(reach, *home, odometry);
  } else {
    explorer_.try_blocked_again();
  }
  if (!turns_home) return;
  note_place(SurveyState::kGoesHome, odometry);
  if (home) rows_.back().cost_m = reach.cost_m(*home);
  rows_.back().end = all_seen_ ? SurveyEnd::kAllSeen : SurveyEnd::kBack;
}

void Survey::choose(const Pose2& odometry, std::int64_t now_ms) {
  chosen_ms_ = now_ms;
  goal_m_.reset();
  waits_for_companion_ = false;
  if (layouts_ != explorer_.layouts()) target_m_.reset();
  layouts_ = explorer_.layouts();
  const Reach reach = explorer_.reach(odometry);
  if (goes_home_ || is_time_to_go_home(reach, now_ms)) return go_home(reach, odometry);
  if (!reach.anywhere()) return;
  const auto driven_to = target_m_ ? std::optional(DrivenTo{*target_m_, changes_}) : std::nullopt;
  const auto next = explorer_.next(reach, driven_to);
  const std::optional<Eigen::Vector2d> before_m = std::exchange(target_m_, std::nullopt);
  if (next) {
    drive_on(reach, next->cell, odometry);
    const bool same = before_m && (*before_m - *target_m_).norm() < reach.frame().cell_m;
    if (same) {
      target_m_ = before_m;  // to the last bit, however the floor's cells are counted now
    } else {
      changes_ = next->overrules ? changes_ + 1 : 0;
    }
    return note_next(*next, before_m, odometry);
  }
  waits_for_companion_ = explorer_.waits_for_companion(reach);
  if (waits_for_companion_) return;
  if (tried_ < config_.tries && explorer_.try_blocked_again()) {
    ++tried_;
    chosen_ms_.reset();
    rows_.push_back(row_of(SurveyState::kTriesAgain, odometry));
    return;
  }
  all_seen_ = true;
  if (back_by_ms_) return go_home(reach, odometry);
  ended_ = SurveyEnd::kAllSeen;
}

/// Whatever it tries, it stays where it is: to call that explored would be wrong.
void Survey::note_blocked(const Pose2& odometry) {
  const bool same_spot = position_m(inverse(blocked_at_) * odometry).norm() < config_.spot_m;
  blocked_in_a_row_ = same_spot ? blocked_in_a_row_ + 1 : 1;
  if (!same_spot) blocked_at_ = odometry;
  if (blocked_in_a_row_ >= config_.stuck_after) ended_ = SurveyEnd::kStuck;
}

/// The place is reached, or cannot be.
void Survey::leave_target(bool reached, const Pose2& odometry) {
  note_place(reached ? SurveyState::kReached : SurveyState::kBlocked, odometry);
  if (reached) blocked_in_a_row_ = 0;
  if (reached && goes_home_) {
    ended_ = all_seen_ ? SurveyEnd::kAllSeen : SurveyEnd::kBack;
    return;
  }
  // What it came for has been seen by now, or cannot be seen; a way may be free again later.
  if (reached) {
    explorer_.give_up(*target_m_);
  } else {
    explorer_.put_off(*target_m_, goal_m_.value_or(*target_m_));
    note_blocked(odometry);
  }
  forget_target();
}

/// Without anywhere to drive to it waits a while, for whoever stands around it to go.
void Survey::note_waiting(std::int64_t now_ms) {
  if (ended_ || goal_m_ || waits_for_companion_) return waiting_since_ms_.reset();
  waiting_since_ms_ = waiting_since_ms_.value_or(now_ms);
  if (now_ms - *waiting_since_ms_ > config_.waits_ms) ended_ = SurveyEnd::kStuck;
}

SurveyStep Survey::go_on(const RangeSweep& sweep, const Pose2& odometry, bool blocked, std::int64_t now_ms) {
  explorer_.see(sweep, odometry);
  SurveyStep step;
  if (ended_) {
    note_end(odometry);
    step.ended = ended_;
    return step;
  }
  step.takes_picture = explorer_.wants_picture(odometry);
  if (step.takes_picture) chosen_ms_.reset();
  const bool reached = at_target(odometry);
  if (reached && explorer_.since_picture_m(odometry) >= config_.least_between_m) step.takes_picture = true;
  if (reached || (blocked && target_m_)) leave_target(reached, odometry);
  if (explorer_.views().empty()) return step;
  if (!ended_ && (!chosen_ms_ || now_ms - *chosen_ms_ >= config_.chosen_every_ms)) choose(odometry, now_ms);
  note_waiting(now_ms);
  if (step.takes_picture) {
    // What it shows may open more.
    if (ended_ == SurveyEnd::kAllSeen && !goes_home_) ended_.reset();
  } else {
    step.ended = ended_;
    if (ended_) note_end(odometry);
  }
  if (goal_m_ && !step.ended) {
    const Pose2 odometry_from_floor = odometry * inverse(explorer_.floor_from_robot(odometry));
    step.goal_m = position_m(odometry_from_floor * Pose2{goal_m_->x(), goal_m_->y(), 0.0});
  }
  return step;
}

void Survey::take(const RangeSweep& sweep, const Pose2& odometry,
                  std::shared_ptr<const features::Appearance> appearance) {
  const std::vector<KnownAgain> before = explorer_.known_again();
  explorer_.take(sweep, odometry, std::move(appearance));
  const int picture = static_cast<int>(explorer_.views().size()) - 1;
  for (const SurveyRow& row :
       picture_rows(before, explorer_.known_again(), picture, explorer_.floor_from_robot(odometry)))
    rows_.push_back(row);
  chosen_ms_.reset();
}

}  // namespace homeward::exploration
