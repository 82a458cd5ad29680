// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "core/ids.hpp"

namespace homeward::wire {

/// proto/schemas/similarity.schema.json. `revision`: of the map that the build made.
nlohmann::json similarity_to_json(std::int64_t revision, int tile_px, int levels, const std::vector<ImageId>& images);

}  // namespace homeward::wire
