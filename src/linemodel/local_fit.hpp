// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/pose2.hpp"
#include "linemodel/picture_lines.hpp"
#include "linemodel/plan_tracker.hpp"

namespace homeward::linemodel {

struct LocalFitConfig {
  double step_m = 0.4;          // of the first, coarse grid
  double step_rad = 0.27;       // the same
  double coarse_rad = 0.1;      // tolerance of the measure on it; half with each halving of the grid
  int halvings = 3;             // of the grid, around the best few
  std::size_t best = 12;        // so many
  double doubted_lines = 15.0;  // as if so many lines more were expected that say nothing: few lines say little
};

/// A pose, and how well the last picture of a tracker fits it.
struct LocalFit {
  Pose2 pose;
  double log_odds = 0.0;   // PictureLines::log_odds over the lines expected and those doubted
  double explained = 0.0;  // PlanTracker::explained over the lines seen and as many doubted

  [[nodiscard]] double agreement() const { return log_odds + explained; }
};

/// The pose within `reach_m` and `reach_rad` (pi: any heading) of another one that a tracker's last picture fits best,
/// by a grid that is refined where its lines are seen; of the best few on the finest, the one that agrees best. Where
/// the plan has no floor around there, `middle` itself. Ours.
LocalFit best_fit_near(PlanTracker& tracker, const Pose2& middle, double reach_m, double reach_rad,
                       const LocalFitConfig& config = {});

}  // namespace homeward::linemodel
