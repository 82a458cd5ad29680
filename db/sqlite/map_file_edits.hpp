// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include "db/sqlite/appearance_pool.hpp"
#include "db/sqlite/map_file_digest.hpp"
#include "map/topological_map.hpp"

namespace homeward::db {

/// Writes the log of edits with what they found out.
void put_edits(SQLite::Database& database, const map::TopologicalMap& map, AppearanceWriter& appearances);

/// Reads it; `appearances` is null for files of before version 7. Throws LoadFailure, and what JSON throws.
void get_edits(SQLite::Database& database, ContentDigest& digest, const AppearanceReader* appearances,
               map::TopologicalMap& map);

}  // namespace homeward::db
