// SPDX-License-Identifier: Apache-2.0
#include "db/sqlite/sqlite_store.hpp"

namespace homeward::db {
namespace {

/// One column of what the latest build of a map left, and a second one.
template <class Take>
auto of_build(SQLite::Database& database, const MapId& id, const char* columns, const Take& take) {
  const std::string sql = std::string("SELECT ") + columns +
                          " FROM maps LEFT JOIN map_builds ON map_builds.map = maps.id WHERE maps.id = ?";
  SQLite::Statement row = prepared(database, sql.c_str(), id);
  if (!row.executeStep()) refuse(ErrorCode::kNotFound, "There is no map with this id.", "maps/" + id.str());
  if (row.isColumnNull(0)) {
    refuse(ErrorCode::kNotFound, "The map was not built here; a build keeps its report.", "maps/" + id.str());
  }
  return take(row);
}

}  // namespace

void SqliteStore::write_build(SQLite::Database& database, const MapId& id, std::int64_t revision,
                              const MapBuild& build) {
  SQLite::Statement insert =
      prepared(database, "INSERT OR REPLACE INTO map_builds (map, revision, report, similarity) VALUES (?, ?, ?, ?)",
               id, revision, build.report);
  insert.bind(4, build.similarity.data(), static_cast<int>(build.similarity.size()));
  insert.exec();
}

Result<std::int64_t> SqliteStore::build_revision(const MapId& id) {
  return database_.read([&](SQLite::Database& database) {
    return of_build(database, id, "map_builds.revision", [](SQLite::Statement& row) { return integer(row, 0); });
  });
}

Result<std::string> SqliteStore::build_report(const MapId& id) {
  return database_.read([&](SQLite::Database& database) {
    return of_build(database, id, "map_builds.report", [](SQLite::Statement& row) { return text(row, 0); });
  });
}

Result<BuildSimilarity> SqliteStore::build_similarity(const MapId& id) {
  return database_.read([&](SQLite::Database& database) {
    return of_build(database, id, "map_builds.revision, map_builds.similarity", [](SQLite::Statement& row) {
      const SQLite::Column blob = row.getColumn(1);
      const auto* bytes = static_cast<const std::uint8_t*>(blob.getBlob());
      return BuildSimilarity{integer(row, 0), {bytes, bytes + blob.getBytes()}};
    });
  });
}

}  // namespace homeward::db
