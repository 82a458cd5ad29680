// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <string>

#include "db/map_file.hpp"
#include "db/sqlite/map_file_failure.hpp"

namespace homeward::db {

/// A map file's rows (`bytes` counts the thumbnails only) and the checksum of all that was read for them. Throws
/// LoadFailure, and what SQLite and JSON throw.
struct MapContents {
  StoredMap stored;
  std::string checksum;
};
MapContents read_contents(SQLite::Database& database);

/// Puts what the rows of a graph part (map_graph_part.hpp) say over the map that they are of. Throws the same.
void read_graph_part(SQLite::Database& database, map::TopologicalMap& map);

}  // namespace homeward::db
