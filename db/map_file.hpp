// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

#include "core/ids.hpp"
#include "core/result.hpp"
#include "map/topological_map.hpp"

namespace homeward::db {

/// Small JPEG pictures of a map's images, for people. Not needed by any method.
using Thumbnails = std::map<ImageId, std::vector<std::uint8_t>>;

struct StoredMap {
  map::TopologicalMap map;
  Thumbnails thumbnails;
  std::int64_t bytes = 0;  // of the file without thumbnails
};

/// Writes one map as one SQLite file (application_id "HWMP"); the file appears whole or not at all, over an older one
/// too. Errors: kIo, kDiskFull.
Status save_map(const std::filesystem::path& file, const map::TopologicalMap& map, const Thumbnails& thumbnails);

/// Errors: kNotFound, kCorruptFile (no SQLite file, not a map, does not hold together), kUnsupportedFormat (newer
/// version).
Result<StoredMap> load_map(const std::filesystem::path& file);

}  // namespace homeward::db
