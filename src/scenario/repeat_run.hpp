// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/result.hpp"
#include "recording/recording_thread.hpp"
#include "scenario/mission_plan.hpp"
#include "scenario/mission_result.hpp"
#include "scenario/scenario_listener.hpp"
#include "scenario/taught_world.hpp"
#include "sim/motion.hpp"

namespace homeward::scenario {

/// Follows the path of `taught`, in simulated time, with the agent's own driving step: from beside where the tour was
/// at the plan's start, as far beside and turned as its seed draws, to where it was at its destination. Recorded when
/// `record` says where. Errors: kInvalidInput (the tour was not there; no start beside it leaves the robot room), and
/// those of PathWatch and Recorder.
Result<MissionResult> run_repeat(TaughtWorld& taught, const MissionPlan& plan, const sim::RobotProfile& profile,
                                 const ScenarioListener& listener,
                                 const std::optional<recording::RecordingOptions>& record);

}  // namespace homeward::scenario
