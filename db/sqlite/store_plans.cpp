// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "db/secrets.hpp"
#include "db/sqlite/sqlite_store.hpp"

namespace homeward::db {
namespace {

using wire::PlanId;

std::string plan_name(const PlanId& id) { return "plans/" + id.str(); }

[[noreturn]] void no_plan(const PlanId& id) {
  refuse(ErrorCode::kNotFound, "There is no plan with this id.", plan_name(id));
}

wire::PlanVersionView version_of(SQLite::Statement& row) {
  wire::PlanVersionView one;
  one.version = integer(row, 0);
  one.format = text(row, 1);
  one.created_us = integer(row, 2);
  one.by = text(row, 3);
  one.metres_per_unit = optional_number(row, 4);
  one.wall_height_m = real(row, 5);
  one.lines = integer(row, 6);
  one.triangles = integer(row, 7);
  one.least_m = {real(row, 8), real(row, 9), real(row, 10)};
  one.most_m = {real(row, 11), real(row, 12), real(row, 13)};
  one.bytes = integer(row, 14);
  if (const auto up = optional_text(row, 15)) one.up = wire::kPlanUpNames.find(*up);
  return one;
}

/// What belongs to a plan in other tables than its own.
void fill_plan(SQLite::Database& database, wire::PlanView& plan) {
  SQLite::Statement row = prepared(
      database,
      "SELECT version, format, created_us, author, metres_per_unit, wall_height_m, line_count, triangle_count, "
      "min_x_m, min_y_m, min_z_m, max_x_m, max_y_m, max_z_m, length(contents), up FROM plan_versions "
      "WHERE plan = ? ORDER BY version",
      plan.id);
  while (row.executeStep()) plan.versions.push_back(version_of(row));
  SQLite::Statement map = prepared(database, "SELECT map FROM map_plans WHERE plan = ? ORDER BY tied_us, map", plan.id);
  while (map.executeStep()) plan.maps.emplace_back(text(map, 0));
}

wire::PlanView need_plan(SQLite::Database& database, const PlanId& id) {
  SQLite::Statement row = prepared(database, "SELECT id, name, created_us FROM plans WHERE id = ?", id);
  if (!row.executeStep()) no_plan(id);
  wire::PlanView plan{PlanId(text(row, 0)), text(row, 1), integer(row, 2), {}, {}};
  fill_plan(database, plan);
  return plan;
}

void insert_version(SQLite::Database& database, const PlanId& plan, const wire::PlanVersionView& one,
                    std::span<const std::uint8_t> file) {
  SQLite::Statement insert =
      prepared(database,
               "INSERT INTO plan_versions (plan, version, format, created_us, author, metres_per_unit, wall_height_m, "
               "line_count, triangle_count, min_x_m, min_y_m, min_z_m, max_x_m, max_y_m, max_z_m, up, contents) "
               "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
               plan, one.version, one.format, one.created_us, one.by, one.metres_per_unit, one.wall_height_m, one.lines,
               one.triangles, one.least_m.x(), one.least_m.y(), one.least_m.z(), one.most_m.x(), one.most_m.y(),
               one.most_m.z(), one.up ? std::optional(std::string(wire::kPlanUpNames.name(*one.up))) : std::nullopt);
  insert.bind(17, file.data(), static_cast<int>(file.size()));
  insert.exec();
}

void need_map_of_plan(SQLite::Database& database, const MapId& map) {
  if (!prepared(database, "SELECT id FROM maps WHERE id = ?", map).executeStep()) {
    refuse(ErrorCode::kNotFound, "There is no map with this id.", "maps/" + map.str());
  }
}

std::vector<map::PlanPin> pins_of(const std::string& text, const MapId& map) {
  const nlohmann::json value = nlohmann::json::parse(text, nullptr, false);
  auto pins = wire::plan_pins_from_json(value, "pins");
  if (!pins) refuse(ErrorCode::kCorruptFile, "Where the map lies on its plan cannot be read.", "maps/" + map.str());
  return std::move(*pins);
}

}  // namespace

Result<wire::PlanView> SqliteStore::add_plan(wire::PlanView plan, std::span<const std::uint8_t> file) {
  return database_.work([&](SQLite::Database& database) {
    if (plan.id.empty()) plan.id = PlanId(random_id());
    execute(database, "INSERT INTO plans (id, name, created_us) VALUES (?, ?, ?)", plan.id, plan.name, plan.created_us);
    wire::PlanVersionView first = plan.versions.at(0);
    first.version = 1;
    insert_version(database, plan.id, first, file);
    return need_plan(database, plan.id);
  });
}

Result<wire::PlanView> SqliteStore::add_plan_version(const PlanId& id, wire::PlanVersionView version,
                                                     std::span<const std::uint8_t> file) {
  return database_.work([&](SQLite::Database& database) {
    const wire::PlanView before = need_plan(database, id);
    if (before.versions.size() >= wire::kMaxPlanVersions) {
      refuse(ErrorCode::kConflict,
             "The plan has " + std::to_string(wire::kMaxPlanVersions) + " versions: upload it as a plan of its own.",
             plan_name(id));
    }
    version.version = before.versions.back().version + 1;
    insert_version(database, id, version, file);
    return need_plan(database, id);
  });
}

Result<std::vector<wire::PlanView>> SqliteStore::plans() {
  return database_.read([&](SQLite::Database& database) {
    std::vector<wire::PlanView> found;
    SQLite::Statement row = prepared(database, "SELECT id, name, created_us FROM plans ORDER BY created_us, rowid");
    while (row.executeStep()) {
      found.push_back({PlanId(text(row, 0)), text(row, 1), integer(row, 2), {}, {}});
      fill_plan(database, found.back());
    }
    return found;
  });
}

Result<wire::PlanView> SqliteStore::plan(const PlanId& id) {
  return database_.read([&](SQLite::Database& database) { return need_plan(database, id); });
}

Result<std::vector<std::uint8_t>> SqliteStore::plan_file(const PlanId& id, std::int64_t version) {
  return database_.read([&](SQLite::Database& database) {
    SQLite::Statement row =
        prepared(database, "SELECT contents FROM plan_versions WHERE plan = ? AND version = ?", id, version);
    if (!row.executeStep()) {
      if (!prepared(database, "SELECT id FROM plans WHERE id = ?", id).executeStep()) no_plan(id);
      refuse(ErrorCode::kNotFound, "The plan has no version " + std::to_string(version) + ".", plan_name(id));
    }
    const SQLite::Column blob = row.getColumn(0);
    const auto* const bytes = static_cast<const std::uint8_t*>(blob.getBlob());
    return std::vector<std::uint8_t>(bytes, bytes + blob.getBytes());
  });
}

Result<wire::PlanView> SqliteStore::rename_plan(const PlanId& id, const std::string& name) {
  return database_.work([&](SQLite::Database& database) {
    if (execute(database, "UPDATE plans SET name = ? WHERE id = ?", name, id) == 0) no_plan(id);
    return need_plan(database, id);
  });
}

Status SqliteStore::remove_plan(const PlanId& id) {
  return database_.work([&](SQLite::Database& database) {
    const wire::PlanView plan = need_plan(database, id);
    if (!plan.maps.empty()) {
      refuse(ErrorCode::kConflict, "The map " + plan.maps.front().str() + " is tied to this plan.", plan_name(id));
    }
    execute(database, "DELETE FROM plans WHERE id = ?", id);
  });
}

Status SqliteStore::tie_map(const MapPlanRecord& tie) {
  return database_.work([&](SQLite::Database& database) {
    need_map_of_plan(database, tie.map);
    if (!prepared(database, "SELECT plan FROM plan_versions WHERE plan = ? AND version = ?", tie.plan, tie.version)
             .executeStep()) {
      refuse(ErrorCode::kNotFound, "There is no such version of this plan.", plan_name(tie.plan));
    }
    execute(database, "DELETE FROM map_plans WHERE map = ?", tie.map);
    execute(database, "INSERT INTO map_plans (map, plan, version, tied_us, author, pins) VALUES (?, ?, ?, ?, ?, ?)",
            tie.map, tie.plan, tie.version, tie.tied_us, tie.author, wire::plan_pins_to_json(tie.pins).dump());
  });
}

Result<MapPlanRecord> SqliteStore::map_plan(const MapId& map) {
  return database_.read([&](SQLite::Database& database) {
    SQLite::Statement row =
        prepared(database, "SELECT plan, version, tied_us, author, pins FROM map_plans WHERE map = ?", map);
    if (!row.executeStep()) {
      need_map_of_plan(database, map);
      refuse(ErrorCode::kNotFound, "The map is tied to no plan.", "maps/" + map.str());
    }
    return MapPlanRecord{map,          PlanId(text(row, 0)),      integer(row, 1), integer(row, 2),
                         text(row, 3), pins_of(text(row, 4), map)};
  });
}

Status SqliteStore::untie_map(const MapId& map) {
  return database_.work([&](SQLite::Database& database) {
    need_map_of_plan(database, map);
    execute(database, "DELETE FROM map_plans WHERE map = ?", map);
  });
}

}  // namespace homeward::db
