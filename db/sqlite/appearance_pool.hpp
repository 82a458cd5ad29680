// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "db/sqlite/map_file_digest.hpp"
#include "map/appearance_list.hpp"

namespace homeward::db {

/// Writes appearances into a map file, each once, however many places and edits share it.
class AppearanceWriter {
 public:
  explicit AppearanceWriter(SQLite::Database& database);
  /// Its number in the file.
  std::int64_t number_of(const map::AppearanceList::Shared& appearance);

 private:
  SQLite::Statement insert_;
  std::unordered_map<const features::Appearance*, std::int64_t> numbers_;
};

/// The appearances of a map file by their numbers; those that several share are shared again.
class AppearanceReader {
 public:
  /// Reads all of them. Throws LoadFailure (kCorruptFile: one that cannot be decoded).
  AppearanceReader(SQLite::Database& database, ContentDigest& digest);
  /// Throws LoadFailure (kCorruptFile: there is none of this number).
  [[nodiscard]] const map::AppearanceList::Shared& at(std::int64_t number) const;

 private:
  std::vector<map::AppearanceList::Shared> appearances_;
};

/// The appearance that a column holds. Throws LoadFailure (kCorruptFile).
features::Appearance appearance_in(const SQLite::Column& column, const std::string& where);

}  // namespace homeward::db
