// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "exploration/explorer.hpp"

namespace homeward::exploration {

struct SurveyConfig {
  std::int64_t chosen_every_ms = 500;   // so often it looks whether another place has become better
  double ahead_m = 1.2;                 // the leg's goal lies so far ahead on the way, as far as that is straight
  double there_m = 0.15;                // so near, the place is reached
  double least_between_m = 0.15;        // of two pictures
  int stuck_after = 5;                  // blocked so often in a row at one spot, it is stuck
  double spot_m = 0.5;                  // and so large that is
  int tries = 2;                        // where ways were blocked, it tries so often again when nothing else is left
  double home_mps = 0.25;               // so fast it gets home at least, by the way's cost
  std::int64_t home_spare_ms = 15'000;  // and this it keeps in hand
};

/// Why a survey has ended.
enum class SurveyEnd : std::uint8_t {
  kAllSeen,  // nothing is left to explore
  kBack,     // its time is over, and it is where it began
  kStuck,    // it does not get away from where it is
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

  /// To be called with each sweep. `blocked`: the leg's goal cannot be got nearer to.
  SurveyStep go_on(const RangeSweep& sweep, const Pose2& odometry, bool blocked, std::int64_t now_ms);
  /// It has to be back where it began by then, by the clock of `go_on`: it turns home in time.
  void be_back_by(std::int64_t at_ms) { back_by_ms_ = at_ms; }
  /// See Explorer::fence_off.
  void fence_off(std::vector<Eigen::Vector2d> corners_m);
  /// The picture that the last step asked for, with the sweep and the odometry of the same moment.
  void take(const RangeSweep& sweep, const Pose2& odometry, std::shared_ptr<const features::Appearance> appearance);

  [[nodiscard]] const Explorer& explorer() const { return explorer_; }
  /// The place driven to; nothing: none.
  [[nodiscard]] const std::optional<Eigen::Vector2d>& target_m() const { return target_m_; }

 private:
  void choose(const Pose2& odometry, std::int64_t now_ms);
  void leave_target(bool blocked, const Pose2& odometry);
  void note_blocked(const Pose2& odometry);
  void turn_home_in_time(const Reach& reach, const Pose2& odometry, std::int64_t now_ms);
  void drive_on(const Reach& reach, std::size_t cell, const Pose2& odometry);
  [[nodiscard]] bool at_target(const Pose2& odometry) const;

  Explorer explorer_;
  SurveyConfig config_;
  std::optional<Eigen::Vector2d> target_m_;
  std::optional<Eigen::Vector2d> goal_m_;  // of the leg, on the floor
  std::optional<std::int64_t> chosen_ms_;
  std::optional<std::int64_t> back_by_ms_;
  bool goes_home_ = false;
  int tried_ = 0;
  int blocked_in_a_row_ = 0;
  Pose2 blocked_at_;  // odometry
  std::optional<SurveyEnd> ended_;
};

}  // namespace homeward::exploration
