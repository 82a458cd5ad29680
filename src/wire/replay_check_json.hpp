// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "map/replay_check.hpp"
#include "map/topological_map.hpp"

namespace homeward::wire {

/// What is worse at a spot of the map `after`, which was `before` until it was edited, in one English sentence.
std::string worse_in_words(const map::WorseSpot& spot, const map::TopologicalMap& before,
                           const map::TopologicalMap& after);

/// What a replay check found: {pictures, right_before, right_after, lost_before, lost_after, routes_before,
/// routes_after, harmless, worse: [{kind, place, other, images, of, distance_m, words}]}, the findings of
/// proto/schemas/replay_check.schema.json.
nlohmann::json replay_check_to_json(const map::ReplayCheck& check, const map::TopologicalMap& before,
                                    const map::TopologicalMap& after);

}  // namespace homeward::wire
