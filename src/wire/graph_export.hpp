// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "map/topological_map.hpp"

namespace homeward::wire {

enum class ExportFormat { kJson, kGraphMl, kGeoJson };

/// "json", "graphml", "geojson", or nothing.
std::optional<ExportFormat> export_format(std::string_view name);

/// A map as text for other programs, without appearances. `layout` as in graph_to_json.
///   json     proto/schemas/graph.schema.json, "map" being the map's name
///   graphml  directed graph; label, prototype, images, x, y on nodes; bearing_rad, turn_rad, length_m, weak, blocked
///   on
///            edges (a missing value is not written)
///   geojson  places as points and edges as lines in drawing coordinates, y upwards: nothing ties them to the Earth
std::string export_graph(const map::TopologicalMap& map, const std::vector<Eigen::Vector2d>& layout,
                         ExportFormat format);

}  // namespace homeward::wire
