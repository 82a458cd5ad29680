// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "map/topological_map.hpp"
#include "map/tour_warning.hpp"

namespace homeward::wire {

/// What `homeward map build` made of a tour (proto/schemas/build.schema.json).
struct BuildView {
  std::string file;
  std::optional<std::string> report;
  std::vector<Error> skipped;  // pictures left out; `where` is the picture
  std::vector<map::TourWarning> warnings;
};

nlohmann::json build_to_json(const BuildView& build, const map::TopologicalMap& map);

}  // namespace homeward::wire
