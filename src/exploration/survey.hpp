// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "exploration/explorer.hpp"

namespace homeward::exploration {

struct SurveyConfig {
  std::int64_t chosen_every_ms = 500;  // so often it looks whether another place has become better
  double ahead_m = 1.2;                // the leg's goal lies so far ahead on the way, as far as that is straight
  double there_m = 0.15;               // so near, the place is reached
  double least_between_m = 0.15;       // of two pictures
};

/// What the robot is to do now.
struct SurveyStep {
  std::optional<Eigen::Vector2d> goal_m;  // to drive to, odometry's frame; nothing: to stand
  bool takes_picture = false;             // first of all
  bool complete = false;                  // nothing is left to explore
};

/// Leads a robot through an exploration, leg by leg: to the place that the explorer names, along the way to it, and to
/// the next. No clock: whoever calls says what time it is.
class Survey {
 public:
  Survey(const ExplorerConfig& explorer, const SurveyConfig& config) : explorer_(explorer), config_(config) {}

  /// To be called with each sweep. `blocked`: the leg's goal cannot be got nearer to.
  SurveyStep go_on(const RangeSweep& sweep, const Pose2& odometry, bool blocked, std::int64_t now_ms);
  /// The picture that the last step asked for, with the sweep and the odometry of the same moment.
  void take(const RangeSweep& sweep, const Pose2& odometry, std::shared_ptr<const features::Appearance> appearance);

  [[nodiscard]] const Explorer& explorer() const { return explorer_; }
  /// The place driven to; nothing: none.
  [[nodiscard]] const std::optional<Eigen::Vector2d>& target_m() const { return target_m_; }

 private:
  void choose(const Pose2& odometry, std::int64_t now_ms);
  [[nodiscard]] bool at_target(const Pose2& odometry) const;

  Explorer explorer_;
  SurveyConfig config_;
  std::optional<Eigen::Vector2d> target_m_;
  std::optional<Eigen::Vector2d> goal_m_;  // of the leg, on the floor
  std::optional<std::int64_t> chosen_ms_;
  bool complete_ = false;
};

}  // namespace homeward::exploration
