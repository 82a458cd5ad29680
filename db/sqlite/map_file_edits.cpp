// SPDX-License-Identifier: Apache-2.0
#include "db/sqlite/map_file_edits.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "db/sqlite/map_file_failure.hpp"
#include "db/sqlite/map_file_schema.hpp"

namespace homeward::db {
namespace {

using nlohmann::json;

// Lists of appearances of an edit.
constexpr int kLooked = 0;
constexpr int kLearnt = 1;

json found_to_json(const map::EditFindings& found) {
  json ways = json::array();
  for (const map::SeenWay& way : found.ways) {
    ways.push_back({{"from", way.from.str()},
                    {"to", way.to.str()},
                    {"bearing_rad", way.bearing_rad ? json(*way.bearing_rad) : json(nullptr)},
                    {"turn_rad", way.turn_rad},
                    {"confidence", way.confidence},
                    {"inliers", way.inliers}});
  }
  json prototypes = json::array();
  for (const ImageId& image : found.prototypes) prototypes.push_back(image.str());
  return {{"made", found.made}, {"prototypes", prototypes}, {"ways", ways}};
}

map::EditFindings found_from_json(const json& value) {
  map::EditFindings found;
  found.made = value.at("made").get<std::string>();
  for (const json& image : value.at("prototypes")) found.prototypes.emplace_back(image.get<std::string>());
  for (const json& one : value.at("ways")) {
    map::SeenWay way;
    way.from = ImageId(one.at("from").get<std::string>());
    way.to = ImageId(one.at("to").get<std::string>());
    if (!one.at("bearing_rad").is_null()) way.bearing_rad = one.at("bearing_rad").get<double>();
    way.turn_rad = one.at("turn_rad").get<double>();
    way.confidence = one.at("confidence").get<double>();
    way.inliers = one.at("inliers").get<int>();
    found.ways.push_back(std::move(way));
  }
  return found;
}

void put_appearances(SQLite::Database& database, std::int64_t edit, int list, const map::AppearanceList& found,
                     AppearanceWriter& appearances) {
  if (found.empty()) return;
  SQLite::Statement insert(database, "INSERT INTO edit_appearances VALUES (?, ?, ?, ?, ?)");
  std::int64_t position = 0;
  for (const auto& entry : found.entries()) {
    insert.bind(1, edit);
    insert.bind(2, list);
    insert.bind(3, position++);
    insert.bind(4, appearances.number_of(entry.appearance));
    insert.bind(5, entry.image.str());
    insert.exec();
    insert.reset();
  }
}

}  // namespace

void put_edits(SQLite::Database& database, const map::TopologicalMap& map, AppearanceWriter& appearances) {
  SQLite::Statement insert(database, "INSERT INTO edits VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  std::int64_t position = 0;
  for (const map::Edit& edit : map.edits) {
    json images = json::array();
    for (const ImageId& image : edit.images) images.push_back(image.str());
    put_appearances(database, position, kLooked, edit.found.appearances, appearances);
    put_appearances(database, position, kLearnt, edit.found.learnt, appearances);
    insert.bind(1, position++);
    insert.bind(2, static_cast<int>(edit.kind));
    insert.bind(3, edit.image_a.str());
    insert.bind(4, edit.image_b.str());
    insert.bind(5, edit.text);
    insert.bind(6, images.dump());
    insert.bind(7, edit.by);
    insert.bind(8, edit.t_us);
    insert.bind(9, edit.undone ? 1 : 0);
    insert.bind(10, edit.change);
    insert.bind(11, edit.redoable ? 1 : 0);
    insert.bind(12, edit.lost);
    insert.bind(13, found_to_json(edit.found).dump());
    insert.exec();
    insert.reset();
  }
}

void get_edits(SQLite::Database& database, ContentDigest& digest, const AppearanceReader* appearances,
               map::TopologicalMap& map) {
  const bool knows_changes = file_version_of(database) >= kFirstVersionWithChanges;
  const std::string sql = std::string("SELECT kind, image_a, image_b, text, images_json, by, t_us, undone") +
                          (knows_changes ? ", change, redoable" : "") +
                          (appearances != nullptr ? ", lost, found_json" : "") + " FROM edits ORDER BY position";
  DigestedRows select(database, sql.c_str(), digest);
  while (select.step()) {
    map::Edit edit;
    const int kind = select.column(0).getInt();
    if (kind < 0 || kind >= static_cast<int>(map::kEditKinds)) refuse_file("An edit has an unknown kind.", "edits");
    edit.kind = static_cast<map::EditKind>(kind);
    edit.image_a = ImageId(select.column(1).getString());
    edit.image_b = ImageId(select.column(2).getString());
    edit.text = select.column(3).getString();
    for (const json& image : json::parse(select.column(4).getString())) {
      edit.images.emplace_back(image.get<std::string>());
    }
    edit.by = select.column(5).getString();
    edit.t_us = select.column(6).getInt64();
    edit.undone = select.column(7).getInt() != 0;
    // In files of before each edit is a change of its own.
    edit.change = knows_changes ? select.column(8).getInt64() : static_cast<std::int64_t>(map.edits.size()) + 1;
    if (edit.change < 1) refuse_file("An edit belongs to no change.", "edits");
    if (knows_changes) edit.redoable = select.column(9).getInt() != 0;
    if (appearances != nullptr) {
      edit.lost = select.column(10).getString();
      edit.found = found_from_json(json::parse(select.column(11).getString()));
    }
    map.edits.push_back(std::move(edit));
  }
  if (appearances == nullptr) return;
  DigestedRows kept(database,
                    "SELECT edit, list, appearance, image FROM edit_appearances ORDER BY edit, list, position", digest);
  while (kept.step()) {
    const std::int64_t edit = kept.column(0).getInt64();
    if (edit < 0 || edit >= static_cast<std::int64_t>(map.edits.size())) refuse_file("There is no such edit.", "edits");
    map::EditFindings& found = map.edits[static_cast<std::size_t>(edit)].found;
    (kept.column(1).getInt() == kLooked ? found.appearances : found.learnt)
        .push_back({appearances->at(kept.column(2).getInt64()), ImageId(kept.column(3).getString())});
  }
}

}  // namespace homeward::db
