// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "map/difference.hpp"

namespace homeward::wire {

/// What is other in a later state of a map (proto/schemas/difference.schema.json).
nlohmann::json difference_to_json(const map::MapDifference& difference);

}  // namespace homeward::wire
