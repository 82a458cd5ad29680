// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "exploration/explorer.hpp"
#include "wire/exploration_json.hpp"

namespace homeward::agent {

/// Adds to a report what the robot knows of the building: nodes, loops, and the floor in cells of 0.1 m or, of a very
/// large one, larger.
void describe(const exploration::Explorer& explorer, wire::ExplorationReport& report);

}  // namespace homeward::agent
