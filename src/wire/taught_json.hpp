// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "map/taught_path.hpp"
#include "map/topological_map.hpp"

namespace homeward::wire {

/// What `homeward teach --json` prints (proto/schemas/taught.schema.json). `file`: the map file, as it was named;
/// `skipped`: pictures that could not be read. Precondition: the map has a path.
nlohmann::json taught_to_json(const std::string& file, const map::TopologicalMap& map,
                              const std::vector<Error>& skipped);

/// "features", "geometry", "error".
std::string cut_reason_name(map::CutReason why);

}  // namespace homeward::wire
