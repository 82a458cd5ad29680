// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "db/map_file.hpp"

namespace homeward::db {

/// What edits of people change in a map, without its images, appearances and thumbnails, which are nearly all of its
/// bytes: names, edges, shortcuts, hypotheses, destinations, the log of edits. A map file (map_file_schema.hpp) whose
/// other tables are empty, as bytes. Throws what SQLite throws.
std::vector<std::uint8_t> graph_part_of(const map::TopologicalMap& map);

/// Puts such a part over the map that it was made from, or an edited one of it. Throws LoadFailure (kCorruptFile) where
/// the places are others, and what SQLite and JSON throw.
void put_graph_part(std::span<const std::uint8_t> bytes, map::TopologicalMap& map);

}  // namespace homeward::db
