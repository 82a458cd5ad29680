// SPDX-License-Identifier: Apache-2.0
#include "db/sqlite/map_file_state.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "db/sqlite/map_file_failure.hpp"
#include "db/sqlite/map_file_schema.hpp"
#include "wire/appearance_blob.hpp"

namespace homeward::db {
namespace {

std::string_view prefix(MapState state) { return state == MapState::kPresent ? "" : kUneditedTables; }
std::string into(MapState state, const char* table) { return "INSERT INTO " + std::string(prefix(state)) + table; }

void bind_optional(SQLite::Statement& statement, int index, const std::optional<double>& value) {
  if (value) {
    statement.bind(index, *value);
  } else {
    statement.bind(index);
  }
}

void put_places(SQLite::Database& database, MapState state, const map::TopologicalMap& map) {
  SQLite::Statement place_insert(database, into(state, "places") + " VALUES (?, ?, ?, ?)");
  std::int64_t position = 0;
  for (const map::Place& place : map.places) {
    place_insert.bind(1, position++);
    place_insert.bind(2, place.id.str());
    place_insert.bind(3, place.label);
    place_insert.bind(4, place.prototype.str());
    place_insert.exec();
    place_insert.reset();
  }
}

void put_edges(SQLite::Database& database, MapState state, const map::TopologicalMap& map) {
  SQLite::Statement insert(database, into(state, "edges") + " VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  std::int64_t position = 0;
  for (const map::Edge& edge : map.edges) {
    insert.bind(1, position++);
    insert.bind(2, edge.from.str());
    insert.bind(3, edge.to.str());
    bind_optional(insert, 4, edge.bearing_rad);
    bind_optional(insert, 5, edge.turn_rad);
    insert.bind(6, edge.length_m);
    insert.bind(7, edge.confidence);
    insert.bind(8, edge.weak ? 1 : 0);
    insert.bind(9, edge.blocked ? 1 : 0);
    insert.bind(10, std::string(map::kDeciderNames.name(edge.by)));
    insert.bind(11, static_cast<int>(edge.length_from));
    insert.bind(12, edge.inliers);
    insert.bind(13, edge.shortcut ? 1 : 0);
    insert.exec();
    insert.reset();
  }
}

void put_shortcuts(SQLite::Database& database, MapState state, const map::TopologicalMap& map) {
  SQLite::Statement insert(database, into(state, "shortcuts") + " VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  std::int64_t position = 0;
  for (const map::Shortcut& shortcut : map.shortcuts) {
    insert.bind(1, position++);
    insert.bind(2, shortcut.image_a.str());
    insert.bind(3, shortcut.image_b.str());
    int index = 4;
    for (const double value : {shortcut.bearing_rad, shortcut.turn_rad, shortcut.back_bearing_rad, shortcut.length_m,
                               shortcut.way_m, shortcut.clear_m, shortcut.confidence}) {
      insert.bind(index++, value);
    }
    insert.bind(11, shortcut.inliers);
    insert.bind(12, static_cast<int>(shortcut.state));
    insert.bind(13, shortcut.by);
    insert.exec();
    insert.reset();
  }
}

void put_hypotheses(SQLite::Database& database, MapState state, const map::TopologicalMap& map) {
  SQLite::Statement insert(database, into(state, "hypotheses") + " VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)");
  std::int64_t position = 0;
  for (const map::Hypothesis& hypothesis : map.hypotheses) {
    insert.bind(1, position++);
    insert.bind(2, hypothesis.prototype_a.str());
    insert.bind(3, hypothesis.prototype_b.str());
    int index = 4;
    for (const double value :
         {hypothesis.similarity, hypothesis.masses_before.is_true, hypothesis.masses_before.is_false,
          hypothesis.masses_before.unknown, hypothesis.masses_after.is_true, hypothesis.masses_after.is_false,
          hypothesis.masses_after.unknown, hypothesis.support, hypothesis.plausibility}) {
      insert.bind(index++, value);
    }
    insert.bind(13, static_cast<int>(hypothesis.decision));
    insert.bind(14, std::string(map::kDeciderNames.name(hypothesis.by)));
    insert.exec();
    insert.reset();
  }
}

void put_destinations(SQLite::Database& database, MapState state, const map::TopologicalMap& map) {
  SQLite::Statement insert(database, into(state, "destinations") + " VALUES (?, ?, ?, ?, ?, ?, ?)");
  std::int64_t position = 0;
  for (const map::Destination& destination : map.destinations) {
    insert.bind(1, position++);
    insert.bind(2, destination.id.str());
    insert.bind(3, destination.place.str());
    insert.bind(4, destination.image.str());
    insert.bind(5, destination.label);
    const std::vector<std::uint8_t> bytes = wire::encode_appearance(destination.appearance);
    insert.bind(6, bytes.data(), static_cast<int>(bytes.size()));
    insert.bind(7, destination.pictogram);
    insert.exec();
    insert.reset();
  }
}

std::optional<double> optional_number(const SQLite::Column& column) {
  return column.isNull() ? std::nullopt : std::optional(column.getDouble());
}

void get_places(SQLite::Database& database, MapState state, ContentDigest& digest, const AppearanceReader* pool,
                map::TopologicalMap& map) {
  const std::string tables(prefix(state));
  DigestedRows places(database, ("SELECT id, label, prototype FROM " + tables + "places ORDER BY position").c_str(),
                      digest);
  DigestedRows members(
      database, ("SELECT image FROM " + tables + "place_members WHERE place = ? ORDER BY position").c_str(), digest);
  DigestedRows appearances(database,
                           ((pool != nullptr ? "SELECT appearance, image FROM " : "SELECT appearance FROM ") + tables +
                            "place_appearances WHERE place = ? ORDER BY position")
                               .c_str(),
                           digest);
  while (places.step()) {
    map::Place place;
    const std::string id = places.column(0).getString();
    place.id = PlaceId(id);
    place.label = places.column(1).getString();
    place.prototype = ImageId(places.column(2).getString());
    members.restart(id);
    while (members.step()) place.members.emplace_back(members.column(0).getString());
    appearances.restart(id);
    while (appearances.step()) {
      if (pool != nullptr) {
        place.appearances.push_back(
            {pool->at(appearances.column(0).getInt64()), ImageId(appearances.column(1).getString())});
        continue;
      }
      // Of those beside the prototype's it is not known what they were taken from.
      const ImageId image = place.appearances.empty() ? place.prototype : ImageId();
      place.appearances.push_back(appearance_in(appearances.column(0), "places/" + id), image);
    }
    map.places.push_back(std::move(place));
  }
}

map::Decider decider(const std::string& name, const std::string& where) {
  const auto known = map::kDeciderNames.find(name);
  if (!known) refuse_file("Neither the method nor a person is said to have decided.", where);
  return *known;
}

/// Files of version 2 do not say where lengths come from: metres where every image has odometry, else images.
map::LengthSource old_length_source(const map::TopologicalMap& map, const map::Edge& edge) {
  if (edge.by == map::Decider::kPerson) return map::LengthSource::kUnknown;
  const bool metric = std::all_of(map.images.begin(), map.images.end(),
                                  [](const map::MapImage& image) { return image.odometry.has_value(); });
  return metric ? map::LengthSource::kOdometry : map::LengthSource::kTourImages;
}

void get_edges(SQLite::Database& database, MapState state, ContentDigest& digest, map::TopologicalMap& map) {
  const bool tells_source = file_version_of(database) >= kFirstVersionWithLengthSource;
  const bool knows_shortcuts = file_version_of(database) >= kFirstVersionWithShortcuts;
  const std::string sql =
      std::string("SELECT from_place, to_place, bearing_rad, turn_rad, length_m, confidence, weak, blocked, by") +
      (tells_source ? ", length_from, inliers" : "") + (knows_shortcuts ? ", shortcut" : "") + " FROM " +
      std::string(prefix(state)) + "edges ORDER BY position";
  DigestedRows select(database, sql.c_str(), digest);
  while (select.step()) {
    map::Edge edge;
    edge.from = PlaceId(select.column(0).getString());
    edge.to = PlaceId(select.column(1).getString());
    edge.bearing_rad = optional_number(select.column(2));
    edge.turn_rad = optional_number(select.column(3));
    edge.length_m = select.column(4).getDouble();
    edge.confidence = select.column(5).getDouble();
    edge.weak = select.column(6).getInt() != 0;
    edge.blocked = select.column(7).getInt() != 0;
    edge.by = decider(select.column(8).getString(), "edges");
    if (!tells_source) {
      edge.length_from = old_length_source(map, edge);
    } else {
      const int source = select.column(9).getInt();
      if (source < 0 || source > static_cast<int>(map::LengthSource::kTourImages)) {
        refuse_file("An edge has a length from an unknown source.", "edges");
      }
      edge.length_from = static_cast<map::LengthSource>(source);
      edge.inliers = select.column(10).getInt();
    }
    if (knows_shortcuts) edge.shortcut = select.column(11).getInt() != 0;
    map.edges.push_back(std::move(edge));
  }
}

void get_shortcuts(SQLite::Database& database, MapState state, ContentDigest& digest, map::TopologicalMap& map) {
  if (file_version_of(database) < kFirstVersionWithShortcuts) return;
  const std::string sql =
      "SELECT image_a, image_b, bearing_rad, turn_rad, back_bearing_rad, length_m, way_m, clear_m, confidence, "
      "inliers, state, by FROM " +
      std::string(prefix(state)) + "shortcuts ORDER BY position";
  DigestedRows select(database, sql.c_str(), digest);
  while (select.step()) {
    map::Shortcut shortcut;
    shortcut.image_a = ImageId(select.column(0).getString());
    shortcut.image_b = ImageId(select.column(1).getString());
    int column = 2;
    for (double* value : {&shortcut.bearing_rad, &shortcut.turn_rad, &shortcut.back_bearing_rad, &shortcut.length_m,
                          &shortcut.way_m, &shortcut.clear_m, &shortcut.confidence}) {
      *value = select.column(column++).getDouble();
    }
    shortcut.inliers = select.column(9).getInt();
    const int decided = select.column(10).getInt();
    if (decided < 0 || decided > static_cast<int>(map::ShortcutState::kRejected)) {
      refuse_file("A shortcut is in an unknown state.", "shortcuts");
    }
    shortcut.state = static_cast<map::ShortcutState>(decided);
    shortcut.by = select.column(11).getString();
    map.shortcuts.push_back(std::move(shortcut));
  }
}

map::Masses get_masses(DigestedRows& select, int first_column) {
  return {select.column(first_column).getDouble(), select.column(first_column + 1).getDouble(),
          select.column(first_column + 2).getDouble()};
}

void get_hypotheses(SQLite::Database& database, MapState state, ContentDigest& digest, map::TopologicalMap& map) {
  const std::string sql =
      "SELECT prototype_a, prototype_b, similarity, before_true, before_false, before_unknown, after_true, "
      "after_false, after_unknown, support, plausibility, decision, by FROM " +
      std::string(prefix(state)) + "hypotheses ORDER BY position";
  DigestedRows select(database, sql.c_str(), digest);
  while (select.step()) {
    map::Hypothesis hypothesis;
    hypothesis.prototype_a = ImageId(select.column(0).getString());
    hypothesis.prototype_b = ImageId(select.column(1).getString());
    hypothesis.similarity = select.column(2).getDouble();
    hypothesis.masses_before = get_masses(select, 3);
    hypothesis.masses_after = get_masses(select, 6);
    hypothesis.support = select.column(9).getDouble();
    hypothesis.plausibility = select.column(10).getDouble();
    const int decision = select.column(11).getInt();
    if (decision < 0 || decision > static_cast<int>(map::Decision::kUndecided)) {
      refuse_file("A hypothesis has an unknown decision.", "hypotheses");
    }
    hypothesis.decision = static_cast<map::Decision>(decision);
    hypothesis.by = decider(select.column(12).getString(), "hypotheses");
    map.hypotheses.push_back(std::move(hypothesis));
  }
}

void get_destinations(SQLite::Database& database, MapState state, ContentDigest& digest, map::TopologicalMap& map) {
  const bool knows_pictograms = file_version_of(database) >= kFirstVersionWithStates;
  const std::string sql = std::string("SELECT id, place, image, label, appearance") +
                          (knows_pictograms ? ", pictogram" : "") + " FROM " + std::string(prefix(state)) +
                          "destinations ORDER BY position";
  DigestedRows select(database, sql.c_str(), digest);
  while (select.step()) {
    map::Destination destination;
    destination.id = DestinationId(select.column(0).getString());
    destination.place = PlaceId(select.column(1).getString());
    destination.image = ImageId(select.column(2).getString());
    destination.label = select.column(3).getString();
    destination.appearance = appearance_in(select.column(4), "destinations/" + destination.id.str());
    if (knows_pictograms) destination.pictogram = select.column(5).getString();
    map.destinations.push_back(std::move(destination));
  }
}

}  // namespace

void put_what_places_hold(SQLite::Database& database, MapState state, const map::TopologicalMap& map,
                          AppearanceWriter& appearances) {
  SQLite::Statement member_insert(database, into(state, "place_members") + " VALUES (?, ?, ?)");
  SQLite::Statement appearance_insert(database, into(state, "place_appearances") + " VALUES (?, ?, ?, ?)");
  for (const map::Place& place : map.places) {
    std::int64_t member_position = 0;
    for (const ImageId& member : place.members) {
      member_insert.bind(1, place.id.str());
      member_insert.bind(2, member_position++);
      member_insert.bind(3, member.str());
      member_insert.exec();
      member_insert.reset();
    }
    std::int64_t appearance_position = 0;
    for (const auto& entry : place.appearances.entries()) {
      appearance_insert.bind(1, place.id.str());
      appearance_insert.bind(2, appearance_position++);
      appearance_insert.bind(3, appearances.number_of(entry.appearance));
      appearance_insert.bind(4, entry.image.str());
      appearance_insert.exec();
      appearance_insert.reset();
    }
  }
}

void put_state(SQLite::Database& database, MapState state, const map::TopologicalMap& map) {
  put_places(database, state, map);
  put_edges(database, state, map);
  put_hypotheses(database, state, map);
  put_shortcuts(database, state, map);
  put_destinations(database, state, map);
}

void get_state(SQLite::Database& database, MapState state, ContentDigest& digest, const AppearanceReader* appearances,
               map::TopologicalMap& map) {
  get_places(database, state, digest, appearances, map);
  get_edges(database, state, digest, map);
  get_hypotheses(database, state, digest, map);
  get_shortcuts(database, state, digest, map);
  get_destinations(database, state, digest, map);
}

}  // namespace homeward::db
