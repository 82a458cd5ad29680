// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>

#include "core/pose2.hpp"
#include "core/result.hpp"
#include "exploration/frame_join.hpp"
#include "scenario/exploration_run.hpp"

namespace homeward::scenario {

/// One of two robots that explore a world together; what it names must outlive the exploration.
struct ExploringTogether {
  SimulatedRobot* robot = nullptr;
  driving::Body body;
  const pipeline::Eye* eye = nullptr;
  ExplorationPlan plan;
  recording::Recorder* recorder = nullptr;  // may be null
};

struct TogetherResult {
  std::array<ExplorationResult, 2> robots;
  std::optional<double> joined_after_m;  // of way, both together, each knew where the other is; nothing: never
  std::optional<double> joined_off_m;    // how wrong that is in the end, at the second one's first picture
};

/// Hears of each picture: whose, the robots counted from 0.
using TogetherProgress = std::function<void(std::size_t, const exploration::Survey&, const ExplorationResult&)>;

/// Two robots explore one world at the same time, as `explore` has one do it, each in the other's way: its laser and
/// its camera show the other as a box. Once their floors are joined (exploration::FrameJoin), each tells the other
/// twice a second what it knows and where it drives. Neither is told where the other began. It ends when both have
/// ended. Errors: those of Eye::look.
Result<TogetherResult> explore_together(const std::array<ExploringTogether, 2>& robots,
                                        const TogetherProgress& progress, const std::function<double()>& clock_ms);

}  // namespace homeward::scenario
