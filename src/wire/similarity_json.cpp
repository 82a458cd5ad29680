// SPDX-License-Identifier: Apache-2.0
#include "wire/similarity_json.hpp"

#include <nlohmann/json.hpp>

#include "wire/json_write.hpp"

namespace homeward::wire {

nlohmann::json similarity_to_json(std::int64_t revision, int tile_px, int levels, const std::vector<ImageId>& images) {
  return {{"format", "homeward-similarity"},
          {"version", 1},
          {"revision", revision},
          {"tile_px", tile_px},
          {"levels", levels},
          {"images", ids_to_json(images)}};
}

}  // namespace homeward::wire
