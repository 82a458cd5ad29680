// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "db/secrets.hpp"
#include "db/sqlite/sqlite_store.hpp"
#include "wire/reason_json.hpp"

namespace homeward::db {
namespace {

using nlohmann::json;

// So many hand-overs and reconnects a server manages on a full disk, and twice as many as a rule.
constexpr std::int64_t kEpochsSetApart = 1000;

RobotRecord robot_of(SQLite::Statement& row) {
  RobotRecord robot;
  robot.id = RobotId(text(row, 0));
  robot.name = text(row, 1);
  if (const auto map = optional_text(row, 2)) robot.map = MapId(*map);
  robot.epoch = integer(row, 3);
  robot.created_us = integer(row, 4);
  return robot;
}

RobotRecord need_robot(SQLite::Database& database, const RobotId& id) {
  SQLite::Statement row = prepared(database, "SELECT id, name, map, epoch, created_us FROM robots WHERE id = ?", id);
  if (!row.executeStep()) refuse(ErrorCode::kNotFound, "There is no robot with this id.", "robots/" + id.str());
  return robot_of(row);
}

wire::MissionView mission_of(SQLite::Statement& row) {
  wire::MissionView mission;
  mission.id = MissionId(text(row, 0));
  mission.robot = RobotId(text(row, 1));
  mission.map = MapId(text(row, 2));
  mission.revision = integer(row, 3);
  if (const auto destination = optional_text(row, 4)) mission.destination = DestinationId(*destination);
  mission.place = PlaceId(text(row, 5));
  const std::optional<wire::MissionState> state = wire::mission_state(text(row, 6));
  if (!state) refuse(ErrorCode::kCorruptFile, "The database holds an unknown state.", "missions/" + mission.id.str());
  mission.state = *state;
  if (const auto reason = optional_text(row, 7)) mission.reason = wire::reason_from_text(*reason);
  mission.epoch = integer(row, 8);
  mission.seq = integer(row, 9);
  for (const json& place : json::parse(text(row, 10))) mission.path.emplace_back(place.get<std::string>());
  mission.path_index = integer(row, 11);
  mission.created_us = integer(row, 12);
  mission.by = text(row, 13);
  mission.arrival_probability = optional_number(row, 14);
  mission.ended_us = optional_integer(row, 15);
  const std::optional<wire::MissionKind> kind = wire::mission_kind(text(row, 16));
  if (!kind) refuse(ErrorCode::kCorruptFile, "The database holds an unknown kind.", "missions/" + mission.id.str());
  mission.kind = *kind;
  if (const auto exploration = optional_text(row, 17)) mission.exploration = ExplorationId(*exploration);
  return mission;
}

std::optional<std::string> reason_column(const wire::MissionView& mission) {
  return mission.reason ? std::optional(wire::reason_to_text(*mission.reason)) : std::nullopt;
}

constexpr const char* kOneMission =
    "SELECT id, robot, map, revision, destination, place, state, reason, epoch, seq, path, path_index, created_us, by, "
    "arrival_probability, ended_us, kind, exploration FROM missions WHERE id = ?";
constexpr const char* kMissionsOfRobot =
    "SELECT id, robot, map, revision, destination, place, state, reason, epoch, seq, path, path_index, created_us, by, "
    "arrival_probability, ended_us, kind, exploration FROM missions WHERE robot = ? ORDER BY created_us DESC, rowid "
    "DESC LIMIT ?";

[[noreturn]] void no_such_mission(const MissionId& id) {
  refuse(ErrorCode::kNotFound, "There is no mission with this id.", "missions/" + id.str());
}

}  // namespace

Result<RobotRecord> SqliteStore::add_robot(RobotRecord robot) {
  return database_.work([&](SQLite::Database& database) {
    if (robot.id.empty()) robot.id = RobotId(random_id());
    if (prepared(database, "SELECT id FROM robots WHERE name = ? COLLATE NOCASE", robot.name).executeStep()) {
      refuse(ErrorCode::kConflict, "There is already a robot called '" + robot.name + "'.", "name");
    }
    execute(database, "INSERT INTO robots (id, name, map, epoch, created_us) VALUES (?, ?, ?, ?, ?)", robot.id,
            robot.name, robot.map, robot.epoch, robot.created_us);
    return robot;
  });
}

Result<std::vector<RobotRecord>> SqliteStore::robots() {
  return database_.read([&](SQLite::Database& database) {
    std::vector<RobotRecord> found;
    SQLite::Statement row = prepared(database, "SELECT id, name, map, epoch, created_us FROM robots ORDER BY name");
    while (row.executeStep()) found.push_back(robot_of(row));
    return found;
  });
}

Result<RobotRecord> SqliteStore::robot(const RobotId& id) {
  return database_.read([&](SQLite::Database& database) { return need_robot(database, id); });
}

Status SqliteStore::set_robot_map(const RobotId& id, const std::optional<MapId>& map) {
  return database_.work([&](SQLite::Database& database) {
    need_robot(database, id);
    if (map && !prepared(database, "SELECT id FROM maps WHERE id = ?", *map).executeStep()) {
      refuse(ErrorCode::kNotFound, "There is no map with this id.", "maps/" + map->str());
    }
    execute(database, "UPDATE robots SET map = ? WHERE id = ?", map, id);
  });
}

Result<std::int64_t> SqliteStore::next_epoch(const RobotId& id) {
  const std::scoped_lock lock(epochs_mutex_);
  const auto found = epochs_.find(id);
  const std::int64_t left = found == epochs_.end() ? 0 : found->second.set_apart - found->second.last;
  if (left < kEpochsSetApart / 2) {
    const auto set_apart = database_.work([&](SQLite::Database& database) {
      execute(database, "UPDATE robots SET epoch = epoch + ? WHERE id = ?", kEpochsSetApart, id);
      return need_robot(database, id).epoch;
    });
    if (!set_apart && left == 0) return pass_on(set_apart);
    if (set_apart) {
      Epochs& epochs = epochs_[id];
      if (left == 0) epochs.last = *set_apart - kEpochsSetApart;
      epochs.set_apart = *set_apart;
    }
  }
  return ++epochs_.at(id).last;
}

Status SqliteStore::remove_robot(const RobotId& id) {
  const std::scoped_lock lock(epochs_mutex_);
  const Status removed = database_.work([&](SQLite::Database& database) {
    need_robot(database, id);
    execute(database, "DELETE FROM robots WHERE id = ?", id);
  });
  if (removed) epochs_.erase(id);
  return removed;
}

Result<wire::MissionView> SqliteStore::add_mission(wire::MissionView mission) {
  return database_.work([&](SQLite::Database& database) {
    need_robot(database, mission.robot);
    if (mission.id.empty()) mission.id = MissionId(random_id());
    json path = json::array();
    for (const PlaceId& place : mission.path) path.push_back(place.str());
    execute(database, "INSERT INTO missions VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)", mission.id,
            mission.robot, mission.map, mission.revision, mission.destination, mission.place,
            std::string(wire::mission_state_name(mission.state)), reason_column(mission), mission.epoch, mission.seq,
            path.dump(), mission.path_index, mission.created_us, mission.by, mission.arrival_probability,
            mission.ended_us, std::string(wire::mission_kind_name(mission.kind)), mission.exploration);
    return mission;
  });
}

Status SqliteStore::update_mission(const wire::MissionView& mission) {
  return database_.work([&](SQLite::Database& database) {
    json path = json::array();
    for (const PlaceId& place : mission.path) path.push_back(place.str());
    if (execute(database,
                "UPDATE missions SET state = ?, reason = ?, epoch = ?, seq = ?, revision = ?, path = ?, "
                "path_index = ?, arrival_probability = ?, ended_us = ? WHERE id = ?",
                std::string(wire::mission_state_name(mission.state)), reason_column(mission), mission.epoch,
                mission.seq, mission.revision, path.dump(), mission.path_index, mission.arrival_probability,
                mission.ended_us, mission.id) == 0) {
      no_such_mission(mission.id);
    }
  });
}

Result<std::vector<wire::MissionView>> SqliteStore::missions(const RobotId& robot, int limit) {
  return database_.read([&](SQLite::Database& database) {
    need_robot(database, robot);
    std::vector<wire::MissionView> found;
    SQLite::Statement row = prepared(database, kMissionsOfRobot, robot, limit);
    while (row.executeStep()) found.push_back(mission_of(row));
    return found;
  });
}

Result<wire::MissionView> SqliteStore::mission(const MissionId& id) {
  return database_.read([&](SQLite::Database& database) {
    SQLite::Statement row = prepared(database, kOneMission, id);
    if (!row.executeStep()) no_such_mission(id);
    return mission_of(row);
  });
}

}  // namespace homeward::db
