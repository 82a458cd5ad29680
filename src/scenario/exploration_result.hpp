// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/pose2.hpp"
#include "core/range_sweep.hpp"
#include "exploration/survey.hpp"

namespace homeward::scenario {

struct ExplorationPlan {
  double limit_m = 2000.0;                             // driven; it ends there
  double limit_s = 7200.0;                             // simulated
  std::optional<double> back_after_s;                  // so long after it began, it is back where it began
  std::vector<std::vector<Eigen::Vector2d>> fences_m;  // corners of what is not driven, by the robot's first pose
  double speed_limit_mps = 0.5;
  exploration::ExplorerConfig explorer;
  exploration::SurveyConfig survey;
};

/// A picture of the tour that an exploration is.
struct ExploredPicture {
  std::vector<std::uint8_t> jpeg;
  RangeSweep sweep;
  double t_s = 0.0;
  Pose2 truth;  // for judging only
};

/// Why an exploration ended.
enum class ExplorationEnd : std::uint8_t { kComplete, kBack, kLimit, kStuck, kStopped };

struct ExplorationResult {
  std::vector<ExploredPicture> pictures;
  std::vector<Pose2> poses;  // of the pictures by what the robot knows in the end; the first one is the origin
  std::vector<exploration::KnownAgain> known_again;
  std::size_t unreached = 0;             // places that were wanted and that blocked ways led to
  std::vector<Eigen::Vector2d> trail_m;  // where it truly drove, for judging only
  ExplorationEnd ended = ExplorationEnd::kComplete;
  std::string reason;  // where it was stopped
  double driven_m = 0.0;
  double duration_s = 0.0;
  int collisions = 0;
  double min_clearance_m = 0.0;
  std::vector<double> step_ms;  // what the machine took for each picture: features, loops, where to go next
};

}  // namespace homeward::scenario
