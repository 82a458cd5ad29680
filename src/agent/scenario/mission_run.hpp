// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "agent/scenario/scenario_run.hpp"
#include "agent/scenario/taught_world.hpp"
#include "sim/motion.hpp"

namespace homeward::agent {

/// One mission to drive.
struct MissionPlan {
  std::string from;
  std::string to;
  std::string light;
  int people = 0;
  std::vector<wire::ScenarioFault> faults;
  std::uint64_t seed = 1;
};

/// Drives one mission in simulated time, with localiser and planner in the server's place; recorded when `record` says
/// where.
Result<MissionResult> run_mission(TaughtWorld& taught, const MissionPlan& plan, const sim::RobotProfile& profile,
                                  const ScenarioListener& listener, const std::optional<RecordingOptions>& record);

}  // namespace homeward::agent
