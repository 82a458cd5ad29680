// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/ids.hpp"
#include "core/result.hpp"
#include "map/topological_map.hpp"

namespace homeward::wire {

/// The graph that a dashboard draws (proto/schemas/graph.schema.json): places, edges, destinations and evidence without
/// appearances. `layout` holds the drawing position of each place, as map::layout gives it.
/// Precondition: one position for each place.
nlohmann::json graph_to_json(const map::TopologicalMap& map, const MapId& id,
                             const std::vector<Eigen::Vector2d>& layout);

/// The entity tag of a revision, with its quotes: "r12".
std::string revision_tag(std::int64_t revision);

/// The revision in an If-Match header ("r12", with or without quotes, also weak). Errors: kInvalidInput.
Result<std::int64_t> revision_from_tag(const std::string& tag);

}  // namespace homeward::wire
