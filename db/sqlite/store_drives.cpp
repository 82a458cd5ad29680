// SPDX-License-Identifier: Apache-2.0
#include "db/sqlite/sqlite_store.hpp"

namespace homeward::db {
namespace {

constexpr int kMostDrivesOfMap = 8;

}  // namespace

Status SqliteStore::add_drive(const Drive& drive) {
  return database_.work([&](SQLite::Database& database) {
    SQLite::Statement map = prepared(database, "SELECT refine FROM maps WHERE id = ?", drive.map);
    if (!map.executeStep()) {
      refuse(ErrorCode::kNotFound, "There is no map with this id.", "maps/" + drive.map.str());
    }
    if (text(map, 0) == wire::refine_mode_name(wire::RefineMode::kOff)) return;
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
        prepared(database, "SELECT mission FROM drives WHERE map = ? AND used = 0 ORDER BY created_us, rowid", map);
    while (row.executeStep()) found.emplace_back(text(row, 0));
    return found;
  });
}

Result<std::vector<MissionId>> SqliteStore::kept_drives(const MapId& map) {
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

Status SqliteStore::use_drives(const std::vector<MissionId>& missions) {
  return database_.work([&](SQLite::Database& database) { mark_drives_used(database, missions); });
}

Status SqliteStore::count_way_drives(const MapId& map, const std::vector<DrivenWay>& ways, bool driven, TimeUs t_us) {
  return database_.work([&](SQLite::Database& database) {
    if (!prepared(database, "SELECT id FROM maps WHERE id = ?", map).executeStep()) {
      refuse(ErrorCode::kNotFound, "There is no map with this id.", "maps/" + map.str());
    }
    for (const DrivenWay& way : ways) {
      execute(database,
              "INSERT INTO way_drives (map, from_place, to_place, driven, failed, last_driven_us, last_failed_us) "
              "VALUES (?, ?, ?, ?, ?, ?, ?) ON CONFLICT (map, from_place, to_place) DO UPDATE SET "
              "driven = driven + excluded.driven, failed = failed + excluded.failed, "
              "last_driven_us = max(last_driven_us, excluded.last_driven_us), "
              "last_failed_us = max(last_failed_us, excluded.last_failed_us)",
              map, way.from, way.to, driven ? 1 : 0, driven ? 0 : 1, driven ? t_us : 0, driven ? 0 : t_us);
    }
  });
}

Result<std::vector<WayDrives>> SqliteStore::way_drives(const MapId& map) {
  return database_.read([&](SQLite::Database& database) {
    SQLite::Statement row =
        prepared(database,
                 "SELECT from_place, to_place, driven, failed, last_driven_us, last_failed_us FROM way_drives "
                 "WHERE map = ? ORDER BY from_place, to_place",
                 map);
    std::vector<WayDrives> found;
    while (row.executeStep()) {
      found.push_back({PlaceId(text(row, 0)), PlaceId(text(row, 1)), integer(row, 2), integer(row, 3), integer(row, 4),
                       integer(row, 5)});
    }
    return found;
  });
}

void SqliteStore::mark_drives_used(SQLite::Database& database, const std::vector<MissionId>& missions) {
  for (const MissionId& mission : missions) execute(database, "UPDATE drives SET used = 1 WHERE mission = ?", mission);
}

}  // namespace homeward::db
