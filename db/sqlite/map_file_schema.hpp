// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <string>
#include <string_view>

namespace homeward::db {

/// "HWMP" in SQLite's application_id field: what makes an SQLite file a Homeward map.
inline constexpr int kMapApplicationId = 0x48574D50;
/// user_version of the map file. A released schema is never edited; a newer file is refused.
inline constexpr int kMapFileVersion = 9;
/// Version 8 does not say which gaps of a path were bridged, nor that one is closed. Version 7 knows no paths that were
/// taught. Version 6 does not keep how the map was without its edits, what edits found out, which picture an appearance
/// is of, and pictograms; each place has appearances of its own. Version 5 does not say which edits belong to one
/// change. Version 4 knows no shortcuts. Version 3 is without document frequencies in its appearances
/// (wire/appearance_blob.hpp). Version 2 is without the checksum, and its edges do not say what their length was taken
/// from and how much both ends see.
inline constexpr int kOldestMapFileVersion = 2;
inline constexpr int kFirstVersionWithChecksum = 3;
inline constexpr int kFirstVersionWithLengthSource = 3;
inline constexpr int kFirstVersionWithShortcuts = 5;
inline constexpr int kFirstVersionWithChanges = 6;
inline constexpr int kFirstVersionWithStates = 7;
inline constexpr int kFirstVersionWithPaths = 8;
inline constexpr int kFirstVersionWithBridges = 9;

/// Before the names of the tables that say how the map was without edits.
inline constexpr std::string_view kUneditedTables = "unedited_";

/// user_version of a map file.
inline int file_version_of(SQLite::Database& database) { return database.execAndGet("PRAGMA user_version").getInt(); }

inline constexpr const char* kSelectChecksum = "SELECT value FROM meta WHERE key = 'checksum'";
inline constexpr const char* kInsertChecksum = "INSERT INTO meta(key, value) VALUES ('checksum', ?)";

/// The tables of one state of the map; @ stands for what their names begin with.
inline constexpr std::string_view kStateSchema = R"sql(
CREATE TABLE @places (
  position INTEGER PRIMARY KEY, id TEXT NOT NULL UNIQUE, label TEXT NOT NULL, prototype TEXT NOT NULL) STRICT;
CREATE TABLE @place_members (
  place TEXT NOT NULL REFERENCES @places(id), position INTEGER NOT NULL, image TEXT NOT NULL REFERENCES images(id),
  PRIMARY KEY (place, position)) STRICT;
CREATE TABLE @place_appearances (
  place TEXT NOT NULL REFERENCES @places(id), position INTEGER NOT NULL,
  appearance INTEGER NOT NULL REFERENCES appearances(number), image TEXT NOT NULL,
  PRIMARY KEY (place, position)) STRICT;
CREATE TABLE @edges (
  position INTEGER PRIMARY KEY, from_place TEXT NOT NULL REFERENCES @places(id),
  to_place TEXT NOT NULL REFERENCES @places(id), bearing_rad REAL, turn_rad REAL, length_m REAL NOT NULL,
  confidence REAL NOT NULL, weak INTEGER NOT NULL, blocked INTEGER NOT NULL, by TEXT NOT NULL,
  length_from INTEGER NOT NULL, inliers INTEGER NOT NULL, shortcut INTEGER NOT NULL) STRICT;
CREATE TABLE @shortcuts (
  position INTEGER PRIMARY KEY, image_a TEXT NOT NULL REFERENCES images(id),
  image_b TEXT NOT NULL REFERENCES images(id), bearing_rad REAL NOT NULL, turn_rad REAL NOT NULL,
  back_bearing_rad REAL NOT NULL, length_m REAL NOT NULL, way_m REAL NOT NULL, clear_m REAL NOT NULL,
  confidence REAL NOT NULL, inliers INTEGER NOT NULL, state INTEGER NOT NULL, by TEXT NOT NULL) STRICT;
CREATE TABLE @hypotheses (
  position INTEGER PRIMARY KEY, prototype_a TEXT NOT NULL, prototype_b TEXT NOT NULL, similarity REAL NOT NULL,
  before_true REAL NOT NULL, before_false REAL NOT NULL, before_unknown REAL NOT NULL,
  after_true REAL NOT NULL, after_false REAL NOT NULL, after_unknown REAL NOT NULL,
  support REAL NOT NULL, plausibility REAL NOT NULL, decision INTEGER NOT NULL, by TEXT NOT NULL) STRICT;
CREATE TABLE @destinations (
  position INTEGER PRIMARY KEY, id TEXT NOT NULL UNIQUE, place TEXT NOT NULL, image TEXT NOT NULL,
  label TEXT NOT NULL, appearance BLOB NOT NULL, pictogram TEXT NOT NULL) STRICT;
)sql";

/// All tables of a map file.
inline std::string map_file_schema() {
  std::string schema = R"sql(
CREATE TABLE meta (key TEXT PRIMARY KEY, value TEXT NOT NULL) STRICT;
CREATE TABLE images (
  position INTEGER PRIMARY KEY, id TEXT NOT NULL UNIQUE, t_us INTEGER,
  odometry_x_m REAL, odometry_y_m REAL, odometry_theta_rad REAL) STRICT;
CREATE TABLE appearances (number INTEGER PRIMARY KEY, appearance BLOB NOT NULL) STRICT;
CREATE TABLE edits (
  position INTEGER PRIMARY KEY, kind INTEGER NOT NULL, image_a TEXT NOT NULL, image_b TEXT NOT NULL,
  text TEXT NOT NULL, images_json TEXT NOT NULL, by TEXT NOT NULL, t_us INTEGER NOT NULL,
  undone INTEGER NOT NULL, change INTEGER NOT NULL, redoable INTEGER NOT NULL, lost TEXT NOT NULL,
  found_json TEXT NOT NULL) STRICT;
CREATE TABLE edit_appearances (
  edit INTEGER NOT NULL, list INTEGER NOT NULL, position INTEGER NOT NULL,
  appearance INTEGER NOT NULL REFERENCES appearances(number), image TEXT NOT NULL,
  PRIMARY KEY (edit, list, position)) STRICT;
CREATE TABLE thumbnails (image TEXT PRIMARY KEY, jpeg BLOB NOT NULL) STRICT;
CREATE TABLE path_key_images (
  position INTEGER PRIMARY KEY, image TEXT NOT NULL REFERENCES images(id), shown INTEGER NOT NULL,
  picture BLOB NOT NULL, features BLOB NOT NULL, common INTEGER NOT NULL,
  scale_ratio REAL, scale_common INTEGER, scale_spread REAL) STRICT;
CREATE TABLE path_arcs (
  position INTEGER PRIMARY KEY, from_key_image INTEGER NOT NULL UNIQUE REFERENCES path_key_images(position),
  arc BLOB NOT NULL) STRICT;
CREATE TABLE path_cuts (
  position INTEGER PRIMARY KEY, last_shown INTEGER NOT NULL, next_shown INTEGER, why INTEGER NOT NULL) STRICT;
CREATE TABLE path_skipped (position INTEGER PRIMARY KEY, shown INTEGER NOT NULL) STRICT;
CREATE TABLE path_bridges (
  position INTEGER PRIMARY KEY, last_shown INTEGER NOT NULL, next_shown INTEGER NOT NULL,
  matched INTEGER NOT NULL) STRICT;
CREATE TABLE path_closing (
  position INTEGER PRIMARY KEY CHECK (position = 0), key_image INTEGER NOT NULL REFERENCES path_key_images(position),
  common INTEGER NOT NULL, scale_ratio REAL, scale_common INTEGER, scale_spread REAL) STRICT;
)sql";
  for (const std::string_view prefix : {std::string_view(), kUneditedTables}) {
    for (const char letter : kStateSchema) letter == '@' ? schema += prefix : schema += letter;
  }
  return schema;
}

}  // namespace homeward::db
