// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <memory>
#include <vector>

#include "db/sqlite/map_file_digest.hpp"
#include "map/taught_path.hpp"
#include "map/topological_map.hpp"

namespace homeward::db {

/// The tables path_* of a map file, which are empty where a map was not taught as a path. Throws what SQLite throws.
void put_path(SQLite::Database& database, const map::MapPath& path);

/// What they say; null where they are empty, and of files of before. `images`: of the map. Throws LoadFailure
/// (kCorruptFile, kUnsupportedFormat) where the path does not hold together, and what SQLite throws.
std::shared_ptr<const map::MapPath> get_path(SQLite::Database& database, ContentDigest& digest,
                                             const std::vector<map::MapImage>& images);

}  // namespace homeward::db
