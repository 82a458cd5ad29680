// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "map/replay_check.hpp"
#include "map/topological_map.hpp"

namespace homeward::pipeline {

/// Adds to a check how many ordered pairs of destinations have an open way before and after edits, and those that both
/// maps have and that lead to each other no more, each pair once. Ours.
void check_routes(const map::TopologicalMap& before, const map::TopologicalMap& after, map::ReplayCheck& check);

}  // namespace homeward::pipeline
