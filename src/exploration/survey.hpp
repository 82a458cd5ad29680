// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "exploration/explorer.hpp"
#include "exploration/survey_row.hpp"

namespace homeward::exploration {

struct SurveyConfig {
  std::int64_t chosen_every_ms = 500;   // so often it looks whether another place has become better
  double ahead_m = 1.2;                 // the leg's goal lies so far ahead on the way, as far as that is straight
  double there_m = 0.15;                // so near, the place is reached
  double least_between_m = 0.15;        // of two pictures
  int stuck_after = 5;                  // blocked so often in a row at one spot, it is stuck
  double spot_m = 0.5;                  // and so large that is
  int tries = 2;                        // where ways were blocked, it tries so often again when nothing else is left
  std::int64_t waits_ms = 20'000;       // so long it waits where it can drive nowhere
  double home_mps = 0.25;               // so fast it gets home at least, by the way's cost
  std::int64_t home_spare_ms = 15'000;  // and this it keeps in hand
};

/// What the robot is to do now.
struct SurveyStep {
  std::optional<Eigen::Vector2d> goal_m;  // to drive to, odometry's frame; nothing: to stand
  bool takes_picture = false;             // first of all
  std::optional<SurveyEnd> ended;         // and there it stands
};

/// Leads a robot through an exploration, leg by leg: to the place that the explorer names, along the way to it, and to
/// the next. No clock: whoever calls says what time it is.
class Survey {
 public:
  Survey(const ExplorerConfig& explorer, const SurveyConfig& config) : explorer_(explorer), config_(config) {}

  /// To be called with each sweep. `blocked`: it does not get on to the leg's goal.
  SurveyStep go_on(const RangeSweep& sweep, const Pose2& odometry, bool blocked, std::int64_t now_ms);
  /// It has to be back where it began by then, by the clock of `go_on`: it turns home in time, as far as ways stay
  /// free, and goes home when it has seen all before.
  void be_back_by(std::int64_t at_ms) { back_by_ms_ = at_ms; }
  /// Or need not be.
  void need_not_be_back() { back_by_ms_.reset(); }
  /// See Explorer::set_fences.
  void set_fences(std::vector<std::vector<Eigen::Vector2d>> fences_m);
  /// See Explorer::set_companion. While nothing is left but what the other is at, it stands and waits.
  void set_companion(std::optional<Companion> companion) { explorer_.set_companion(std::move(companion)); }
  /// What it tells that one.
  [[nodiscard]] CompanionReport report(const Pose2& odometry) const;
  /// It goes on after a pause, or after it has ended: what was blocked may be free. `odometry_moved`: see
  /// Explorer::move_odometry.
  void go_on_anew(const std::optional<Pose2>& odometry_moved);
  /// A limit that others keep is reached: it has ended there, until `go_on_anew`.
  void end_at_limit(const Pose2& odometry);
  /// The picture that the last step asked for, with the sweep and the odometry of the same moment.
  void take(const RangeSweep& sweep, const Pose2& odometry, std::shared_ptr<const features::Appearance> appearance);

  /// See Explorer::give_up_again.
  void give_up_again(const Explorer::Spot& spot) { explorer_.give_up_again(spot); }

  /// The rows of its table of states since this was called last, in their order.
  std::vector<SurveyRow> take_rows() { return std::exchange(rows_, {}); }

  [[nodiscard]] const Explorer& explorer() const { return explorer_; }
  /// The place driven to; nothing: none.
  [[nodiscard]] const std::optional<Eigen::Vector2d>& target_m() const { return target_m_; }

 private:
  void choose(const Pose2& odometry, std::int64_t now_ms);
  [[nodiscard]] bool is_time_to_go_home(const Reach& reach, std::int64_t now_ms) const;
  void go_home(const Reach& reach, const Pose2& odometry);
  void drive_on(const Reach& reach, std::size_t cell, const Pose2& odometry);
  void leave_target(bool reached, const Pose2& odometry);
  void forget_target();
  void note_blocked(const Pose2& odometry);
  void note_waiting(std::int64_t now_ms);
  [[nodiscard]] bool at_target(const Pose2& odometry) const;
  [[nodiscard]] SurveyRow row_of(SurveyState state, const Pose2& odometry) const;
  void note_place(SurveyState state, const Pose2& odometry);
  void note_next(const NextView& next, const std::optional<Eigen::Vector2d>& before_m, const Pose2& odometry);
  void note_end(const Pose2& odometry);

  Explorer explorer_;
  SurveyConfig config_;
  std::optional<Eigen::Vector2d> target_m_;
  int changes_ = 0;                        // of mind about it in a row
  std::optional<Eigen::Vector2d> goal_m_;  // of the leg, on the floor
  std::optional<std::int64_t> chosen_ms_;
  std::optional<std::int64_t> back_by_ms_;
  bool goes_home_ = false;
  bool all_seen_ = false;
  bool waits_for_companion_ = false;
  std::optional<std::int64_t> waiting_since_ms_;
  int layouts_ = 0;
  int tried_ = 0;
  int blocked_in_a_row_ = 0;
  Pose2 blocked_at_;  // odometry
  std::optional<SurveyEnd> ended_;
  bool end_noted_ = false;
  std::vector<SurveyRow> rows_;
};

}  // namespace homeward::exploration
