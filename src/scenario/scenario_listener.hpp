// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "scenario/cycle_trace.hpp"
#include "scenario/mission_result.hpp"

namespace homeward::scenario {

/// What a scenario's runner hears; functions that are not set are not called.
struct ScenarioListener {
  std::function<void(const std::string&)> log;
  std::function<void(const MissionResult&)> done;
  std::function<void(const CycleTrace&)> cycled;
};

}  // namespace homeward::scenario
