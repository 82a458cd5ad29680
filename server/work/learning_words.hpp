// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/result.hpp"
#include "map/topological_map.hpp"
#include "mapping/grow.hpp"
#include "mapping/refine.hpp"

namespace homeward::server {

/// Which places gained how many appearances, in whole sentences; `offered`: would gain.
std::vector<std::string> words_of(const map::TopologicalMap& map, const mapping::Refinement& refinement, bool offered);

/// What tours brought to a map.
std::vector<std::string> words_of(const mapping::GrowthCounts& added);

/// One sentence on pictures that cannot be read, with the first of them; nothing when there are none.
std::vector<std::string> words_of_skipped(const std::vector<Error>& skipped);

}  // namespace homeward::server
