// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "wire/scenario_json.hpp"

namespace homeward::agent {

struct StopEvent {
  double t_s = 0.0;
  std::string reason;
};

/// How one mission of a scenario went. Errors are measured to the true pose of the destination's picture.
struct MissionResult {
  std::string from;
  std::string to;
  bool arrived = false;
  double final_error_m = 0.0;
  double final_error_rad = 0.0;
  double path_m = 0.0;
  double shortest_m = 0.0;
  double min_clearance_m = 0.0;
  int collisions = 0;
  std::vector<StopEvent> stops;
  double vectors_per_s = 0.0;
  double duration_s = 0.0;
};

/// Teaches a world by a tour, builds its map and drives the missions with the agent's own heart, in simulated time and as
/// fast as the machine allows. Same scenario, same results. `told` is called with what goes on, `done` after each mission.
/// Errors: those of load_world, plan_tour and build_map; kInvalidInput for a destination that the tour does not visit.
Status run_scenario(const wire::ScenarioFile& scenario, const std::string& folder,
                    const std::function<void(const std::string&)>& told,
                    const std::function<void(const MissionResult&)>& done);

}  // namespace homeward::agent
