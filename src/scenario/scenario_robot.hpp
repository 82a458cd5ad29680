// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/motion.hpp"
#include "wire/scenario_json.hpp"

namespace homeward::scenario {

/// The robot that a scenario names.
sim::RobotProfile profile_of(const wire::ScenarioFile& scenario);

}  // namespace homeward::scenario
