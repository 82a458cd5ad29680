// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "wire/scenario_json.hpp"

namespace homeward::scenario {

/// One mission to drive.
struct MissionPlan {
  std::string from;
  std::string to;
  std::string light;
  int people = 0;
  int moved_furniture = 0;  // pieces in each room
  std::vector<wire::ScenarioFault> faults;
  std::uint64_t seed = 1;
  std::size_t entry = 0;           // of the scenario's missions
  std::string answers = "nobody";  // what somebody says whom the robot asks (bystander.hpp)
  double speed_limit_mps = wire::kSpeedLimit_mps;
  double start_beside_m = 0.0;  // of a path that is repeated: at most
  double start_turned_rad = 0.0;
  wire::RepeatSteering steering = wire::RepeatSteering::kWay;
  int rounds = 0;  // of a closed path: so often it passes its destination first
};

/// How many missions a scenario has, those at random counted one by one.
int count_missions(const wire::ScenarioFile& scenario);

/// The missions of a scenario, those at random drawn from `destinations`, of which there must be two for them.
/// Same scenario and destinations, same missions.
std::vector<MissionPlan> plan_missions(const wire::ScenarioFile& scenario, std::vector<std::string> destinations);

}  // namespace homeward::scenario
