// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <set>
#include <string>

#include "core/result.hpp"
#include "recording/recording_thread.hpp"
#include "scenario/scenario_listener.hpp"
#include "wire/scenario_json.hpp"

namespace homeward::scenario {

/// Teaches a world by a tour, builds its map and drives the missions with the agent's own driving step, in simulated
/// time and as fast as the machine allows. Same scenario, same results. Nothing is rendered of a scenario that
/// check_scenario finds wrong: kInvalidInput then names all its problems. Errors: also those of load_world, read_camera
/// and build_map; kInvalidInput where furniture was moved and the robot no longer fits at a room's point. `record`:
/// keeps a recording of each mission, named by number, start and destination. Errors: also those of Recorder. `only`:
/// numbers of the missions to drive, from 1; each goes as it goes among all. Empty: all. Errors: kInvalidInput for a
/// number that the scenario has no mission of.
Status run_scenario(wire::ScenarioFile scenario, const std::string& folder, const ScenarioListener& listener,
                    const std::optional<recording::RecordingOptions>& record = std::nullopt,
                    const std::set<int>& only = {});

}  // namespace homeward::scenario
