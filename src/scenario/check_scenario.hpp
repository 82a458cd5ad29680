// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/result.hpp"
#include "sim/scene.hpp"
#include "wire/scenario_json.hpp"

namespace homeward::scenario {

/// Something in a scenario that cannot be done in its world.
struct ScenarioProblem {
  std::string where;    // in the file: "missions[3].to"
  std::string message;  // what is wrong there and what would be right, without a full stop
};

/// All that is wrong with a scenario and can be known before a picture of its world is rendered: rooms that there are
/// not, ways that there are not, destinations that the tour does not visit, light without lamps, furniture that cannot
/// be moved, rooms that the robot does not fit into, tours too small to kidnap a robot on. Empty: all well. Those
/// of tour and missions come first, then those of starts. Not known before: whether the robot fits at a room's point
/// once furniture has been moved.
std::vector<ScenarioProblem> check_scenario(const wire::ScenarioFile& scenario, const sim::World& world);

/// The problems as one error that names each with its place. Precondition: there is one.
Error error_of(const std::vector<ScenarioProblem>& problems);

}  // namespace homeward::scenario
