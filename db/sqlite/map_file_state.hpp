// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <string>

#include "db/sqlite/appearance_pool.hpp"
#include "db/sqlite/map_file_digest.hpp"
#include "map/topological_map.hpp"

namespace homeward::db {

/// The tables of a state of the map: places, edges, hypotheses, shortcuts, destinations, as it is now or as it was
/// without edits.
enum class MapState { kPresent, kUnedited };

/// Writes places (without what they hold), edges, hypotheses, shortcuts and destinations.
void put_state(SQLite::Database& database, MapState state, const map::TopologicalMap& map);
/// Writes the members and appearances of places.
void put_what_places_hold(SQLite::Database& database, MapState state, const map::TopologicalMap& map,
                          AppearanceWriter& appearances);

/// Reads both; `appearances` is null for files of before version 7, which have the present state alone. Throws
/// LoadFailure.
void get_state(SQLite::Database& database, MapState state, ContentDigest& digest, const AppearanceReader* appearances,
               map::TopologicalMap& map);

}  // namespace homeward::db
