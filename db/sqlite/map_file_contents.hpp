// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <stdexcept>
#include <string>
#include <utility>

#include "core/result.hpp"
#include "db/map_file.hpp"

namespace homeward::db {

/// Carries an Error through the reading functions to load_map.
struct LoadFailure : std::runtime_error {
  explicit LoadFailure(Error failure) : std::runtime_error(failure.message), error(std::move(failure)) {}
  Error error;
};

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
