// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "map/topological_map.hpp"

namespace homeward::wire {

/// What `homeward map inspect --json` prints (proto/schemas/inspect.schema.json). `bytes`: size of the map file
/// without thumbnails.
nlohmann::json inspect_to_json(const map::TopologicalMap& map, std::int64_t bytes);

/// {from, to, bearing_rad, turn_rad, length_m, length_from, confidence, inliers, weak, shortcut}; an angle that is not
/// known is null.
nlohmann::json edge_to_json(const map::Edge& edge);

/// {prototype_a, prototype_b, masses_before, masses_after, support, plausibility, decision, by}
nlohmann::json hypothesis_to_json(const map::Hypothesis& hypothesis);

/// Of each shortcut {image_a, image_b, place_a, place_b, bearing_rad, turn_rad, length_m, way_m, clear_m, confidence,
/// inliers, state, by}.
nlohmann::json shortcuts_to_json(const map::TopologicalMap& map);

/// "proposed", "accepted", "rejected".
std::string_view shortcut_state_name(map::ShortcutState state);

/// "unknown", "odometry", "tour_time", "tour_images".
std::string_view length_source_name(map::LengthSource source);

/// "accepted", "rejected", "undecided".
std::string_view decision_name(map::Decision decision);

}  // namespace homeward::wire
