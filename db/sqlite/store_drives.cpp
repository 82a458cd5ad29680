// SPDX-License-Identifier: Apache-2.0
#include "db/sqlite/sqlite_store.hpp"

namespace homeward::db {
namespace {

constexpr int kMostDrivesOfMap = 8;

}  // namespace

Status SqliteStore::add_drive(const Drive& drive) {
  return database_.work([&](SQLite::Database& database) {
    if (!prepared(database, "SELECT id FROM maps WHERE id = ?", drive.map).executeStep()) {
      refuse(ErrorCode::kNotFound, "There is no map with this id.", "maps/" + drive.map.str());
    }
    execute(database, "INSERT OR REPLACE INTO drives (mission, map, feature_config_id, created_us) VALUES (?, ?, ?, ?)",
            drive.mission, drive.map, drive.feature_config_id, drive.created_us);
    std::int64_t number = 0;
    for (const DriveSight& sight : drive.sights) {
      static constexpr std::uint8_t kNothing = 0;
      SQLite::Statement insert(database,
                               "INSERT INTO drive_sights (drive, number, place, appearance) VALUES (?, ?, ?, ?)");
      bind_value(insert, 1, drive.mission);
      bind_value(insert, 2, number);
      bind_value(insert, 3, sight.place);
      // A null pointer would bind NULL.
      insert.bind(4, sight.appearance.empty() ? &kNothing : sight.appearance.data(),
                  static_cast<int>(sight.appearance.size()));
      insert.exec();
      ++number;
    }
    execute(database,
            "DELETE FROM drives WHERE map = ? AND mission NOT IN "
            "(SELECT mission FROM drives WHERE map = ? ORDER BY created_us DESC, rowid DESC LIMIT ?)",
            drive.map, drive.map, kMostDrivesOfMap);
  });
}

Result<std::vector<MissionId>> SqliteStore::drives(const MapId& map) {
  return database_.read([&](SQLite::Database& database) {
    std::vector<MissionId> found;
    SQLite::Statement row =
        prepared(database, "SELECT mission FROM drives WHERE map = ? ORDER BY created_us, rowid", map);
    while (row.executeStep()) found.emplace_back(text(row, 0));
    return found;
  });
}

Result<Drive> SqliteStore::drive(const MissionId& mission) {
  return database_.read([&](SQLite::Database& database) {
    SQLite::Statement row =
        prepared(database, "SELECT map, feature_config_id, created_us FROM drives WHERE mission = ?", mission);
    if (!row.executeStep()) {
      refuse(ErrorCode::kNotFound, "Nothing is kept of this drive.", "missions/" + mission.str());
    }
    Drive drive{mission, MapId(text(row, 0)), text(row, 1), integer(row, 2), {}};
    SQLite::Statement sight =
        prepared(database, "SELECT place, appearance FROM drive_sights WHERE drive = ? ORDER BY number", mission);
    while (sight.executeStep()) {
      const SQLite::Column blob = sight.getColumn(1);
      const auto* bytes = static_cast<const std::uint8_t*>(blob.getBlob());
      drive.sights.push_back({PlaceId(text(sight, 0)), {bytes, bytes + blob.getBytes()}});
    }
    return drive;
  });
}

Status SqliteStore::remove_drives(const std::vector<MissionId>& missions) {
  return database_.work([&](SQLite::Database& database) { forget_drives(database, missions); });
}

void SqliteStore::forget_drives(SQLite::Database& database, const std::vector<MissionId>& missions) {
  for (const MissionId& mission : missions) execute(database, "DELETE FROM drives WHERE mission = ?", mission);
}

}  // namespace homeward::db
