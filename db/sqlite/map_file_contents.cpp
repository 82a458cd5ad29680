// SPDX-License-Identifier: Apache-2.0
#include "db/sqlite/map_file_contents.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>

#include "db/sqlite/map_file_digest.hpp"
#include "db/sqlite/map_file_schema.hpp"
#include "wire/appearance_blob.hpp"
#include "wire/camera_json.hpp"

namespace homeward::db {
namespace {

using nlohmann::json;

[[noreturn]] void refuse(std::string message, std::string where = {}) {
  throw LoadFailure({ErrorCode::kCorruptFile, std::move(message), std::move(where)});
}

std::optional<json> optional_meta(DigestedRows& entries, const std::string& key) {
  entries.restart(key);
  if (!entries.step()) return std::nullopt;
  return json::parse(entries.column(0).getString());
}

json meta(DigestedRows& entries, const std::string& key) {
  std::optional<json> found = optional_meta(entries, key);
  if (!found) refuse("The map file lacks the entry '" + key + "'.", "meta");
  return std::move(*found);
}

void get_meta(SQLite::Database& database, ContentDigest& digest, map::TopologicalMap& map) {
  DigestedRows entries(database, "SELECT value FROM meta WHERE key = ?", digest);
  map.version = meta(entries, "version").get<int>();
  map.name = meta(entries, "name").get<std::string>();
  map.revision = meta(entries, "revision").get<std::int64_t>();
  const Result<camera::CameraConfig> camera = wire::camera_from_json(meta(entries, "camera"));
  if (!camera) refuse("The map's camera cannot be: " + camera.error().message, "meta");
  map.camera = *camera;
  const json features = meta(entries, "feature_config");
  map.feature_config.panorama_width_px = features.at("panorama_width_px").get<int>();
  map.feature_config.elevation_max_rad = features.at("elevation_max_rad").get<double>();
  map.feature_config.elevation_min_rad = features.at("elevation_min_rad").get<double>();
  map.feature_config.max_sift = features.at("max_sift").get<int>();
  map.feature_config.sift_contrast_threshold = features.at("sift_contrast_threshold").get<double>();
  map.feature_config.sift_code_length = features.at("sift_code_length").get<int>();
  map.feature_config.sift_windows = features.value("sift_windows", 1);  // files of before have one
  map.feature_config.max_columns = features.at("max_columns").get<int>();
  map.feature_config_id = meta(entries, "feature_config_id").get<std::string>();
  const json motion = meta(entries, "motion");
  map.motion.hop_spread = motion.at("hop_spread").get<double>();
  map.motion.distance_spread = motion.at("distance_spread").get<double>();
  map.motion.distance_scale = motion.at("distance_scale").get<double>();
  // Files of before have none: the defaults serve.
  if (const auto calibration = optional_meta(entries, "calibration")) {
    map.calibration.offset = calibration->at("offset").get<double>();
    map.calibration.slope = calibration->at("slope").get<double>();
    if (!std::isfinite(map.calibration.offset) || !(map.calibration.slope > 0.0)) {
      refuse("The map's calibration of beliefs cannot be.", "meta");
    }
  }
  map.next_place_number = meta(entries, "next_place_number").get<std::int64_t>();
  map.next_destination_number = meta(entries, "next_destination_number").get<std::int64_t>();
  map.build_seconds = meta(entries, "build_seconds").get<double>();
}

std::optional<double> optional_number(const SQLite::Column& column) {
  return column.isNull() ? std::nullopt : std::optional(column.getDouble());
}

void get_images(SQLite::Database& database, ContentDigest& digest, map::TopologicalMap& map) {
  DigestedRows select(database,
                      "SELECT id, t_us, odometry_x_m, odometry_y_m, odometry_theta_rad FROM images ORDER BY position",
                      digest);
  while (select.step()) {
    map::MapImage image{ImageId(select.column(0).getString()), {}, {}};
    if (!select.column(1).isNull()) image.t_us = select.column(1).getInt64();
    if (!select.column(2).isNull()) {
      image.odometry = Pose2{select.column(2).getDouble(), select.column(3).getDouble(), select.column(4).getDouble()};
    }
    map.images.push_back(std::move(image));
  }
}

features::Appearance get_appearance(const SQLite::Column& column, const std::string& where) {
  const auto* bytes = static_cast<const std::uint8_t*>(column.getBlob());
  const auto size = static_cast<std::size_t>(column.getBytes());
  Result<features::Appearance> appearance = wire::decode_appearance(std::span(bytes, size), where);
  if (!appearance) throw LoadFailure(appearance.error());
  return std::move(*appearance);
}

void get_places(SQLite::Database& database, ContentDigest& digest, map::TopologicalMap& map) {
  DigestedRows places(database, "SELECT id, label, prototype FROM places ORDER BY position", digest);
  DigestedRows members(database, "SELECT image FROM place_members WHERE place = ? ORDER BY position", digest);
  DigestedRows appearances(database, "SELECT appearance FROM place_appearances WHERE place = ? ORDER BY position",
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
      place.appearances.push_back(get_appearance(appearances.column(0), "places/" + id));
    }
    map.places.push_back(std::move(place));
  }
}

map::Decider decider(const std::string& name, const std::string& where) {
  const auto known = map::kDeciderNames.find(name);
  if (!known) refuse("Neither the method nor a person is said to have decided.", where);
  return *known;
}

/// Files of version 2 do not say where lengths come from: metres where every image has odometry, else images.
map::LengthSource old_length_source(const map::TopologicalMap& map, const map::Edge& edge) {
  if (edge.by == map::Decider::kPerson) return map::LengthSource::kUnknown;
  const bool metric = std::all_of(map.images.begin(), map.images.end(),
                                  [](const map::MapImage& image) { return image.odometry.has_value(); });
  return metric ? map::LengthSource::kOdometry : map::LengthSource::kTourImages;
}

int version_of(SQLite::Database& database) { return database.execAndGet("PRAGMA user_version").getInt(); }

void get_edges(SQLite::Database& database, ContentDigest& digest, map::TopologicalMap& map) {
  const bool tells_source = version_of(database) >= kFirstVersionWithLengthSource;
  const bool knows_shortcuts = version_of(database) >= kFirstVersionWithShortcuts;
  const std::string sql =
      std::string("SELECT from_place, to_place, bearing_rad, turn_rad, length_m, confidence, weak, blocked, by") +
      (tells_source ? ", length_from, inliers" : "") + (knows_shortcuts ? ", shortcut" : "") +
      " FROM edges ORDER BY position";
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
        refuse("An edge has a length from an unknown source.", "edges");
      }
      edge.length_from = static_cast<map::LengthSource>(source);
      edge.inliers = select.column(10).getInt();
    }
    if (knows_shortcuts) edge.shortcut = select.column(11).getInt() != 0;
    map.edges.push_back(std::move(edge));
  }
}

void get_shortcuts(SQLite::Database& database, ContentDigest& digest, map::TopologicalMap& map) {
  if (version_of(database) < kFirstVersionWithShortcuts) return;
  DigestedRows select(database,
                      "SELECT image_a, image_b, bearing_rad, turn_rad, back_bearing_rad, length_m, way_m, clear_m, "
                      "confidence, inliers, state, by FROM shortcuts ORDER BY position",
                      digest);
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
    const int state = select.column(10).getInt();
    if (state < 0 || state > static_cast<int>(map::ShortcutState::kRejected)) {
      refuse("A shortcut is in an unknown state.", "shortcuts");
    }
    shortcut.state = static_cast<map::ShortcutState>(state);
    shortcut.by = select.column(11).getString();
    map.shortcuts.push_back(std::move(shortcut));
  }
}

map::Masses get_masses(DigestedRows& select, int first_column) {
  return {select.column(first_column).getDouble(), select.column(first_column + 1).getDouble(),
          select.column(first_column + 2).getDouble()};
}

void get_hypotheses(SQLite::Database& database, ContentDigest& digest, map::TopologicalMap& map) {
  DigestedRows select(database,
                      "SELECT prototype_a, prototype_b, similarity, before_true, before_false, before_unknown, "
                      "after_true, after_false, after_unknown, support, plausibility, decision, by "
                      "FROM hypotheses ORDER BY position",
                      digest);
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
      refuse("A hypothesis has an unknown decision.", "hypotheses");
    }
    hypothesis.decision = static_cast<map::Decision>(decision);
    hypothesis.by = decider(select.column(12).getString(), "hypotheses");
    map.hypotheses.push_back(std::move(hypothesis));
  }
}

void get_destinations(SQLite::Database& database, ContentDigest& digest, map::TopologicalMap& map) {
  DigestedRows select(database, "SELECT id, place, image, label, appearance FROM destinations ORDER BY position",
                      digest);
  while (select.step()) {
    map::Destination destination;
    destination.id = DestinationId(select.column(0).getString());
    destination.place = PlaceId(select.column(1).getString());
    destination.image = ImageId(select.column(2).getString());
    destination.label = select.column(3).getString();
    destination.appearance = get_appearance(select.column(4), "destinations/" + destination.id.str());
    map.destinations.push_back(std::move(destination));
  }
}

void get_edits(SQLite::Database& database, ContentDigest& digest, map::TopologicalMap& map) {
  const bool knows_changes = version_of(database) >= kFirstVersionWithChanges;
  const std::string sql = std::string("SELECT kind, image_a, image_b, text, images_json, by, t_us, undone") +
                          (knows_changes ? ", change, redoable" : "") + " FROM edits ORDER BY position";
  DigestedRows select(database, sql.c_str(), digest);
  while (select.step()) {
    map::Edit edit;
    const int kind = select.column(0).getInt();
    if (kind < 0 || kind > static_cast<int>(map::EditKind::kDecideShortcut))
      refuse("An edit has an unknown kind.", "edits");
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
    if (edit.change < 1) refuse("An edit belongs to no change.", "edits");
    if (knows_changes) edit.redoable = select.column(9).getInt() != 0;
    map.edits.push_back(std::move(edit));
  }
}

/// Places and all that joins, names and edits them.
void get_graph(SQLite::Database& database, ContentDigest& digest, map::TopologicalMap& map) {
  get_places(database, digest, map);
  get_edges(database, digest, map);
  get_hypotheses(database, digest, map);
  get_shortcuts(database, digest, map);
  get_destinations(database, digest, map);
  get_edits(database, digest, map);
}

/// A map that points at places or images that it does not hold must not reach a robot.
void check_references(const map::TopologicalMap& map) {
  std::set<ImageId> images;
  for (const map::MapImage& image : map.images) images.insert(image.id);
  std::set<PlaceId> places;
  for (const map::Place& place : map.places) {
    places.insert(place.id);
    const std::string where = "places/" + place.id.str();
    if (place.members.empty()) refuse("A place has no image.", where);
    if (place.appearances.empty()) refuse("A place has no appearance.", where);
    for (const ImageId& member : place.members) {
      if (!images.contains(member)) refuse("A place names an image that the map does not hold.", where);
    }
    if (!images.contains(place.prototype)) refuse("A place's prototype is not in the map.", where);
  }
  for (const map::Edge& edge : map.edges) {
    if (!places.contains(edge.from) || !places.contains(edge.to)) {
      refuse("An edge names a place that the map does not hold.", "edges");
    }
  }
  for (const map::Shortcut& shortcut : map.shortcuts) {
    if (!images.contains(shortcut.image_a) || !images.contains(shortcut.image_b)) {
      refuse("A shortcut names an image that the map does not hold.", "shortcuts");
    }
  }
  for (const map::Destination& destination : map.destinations) {
    if (!places.contains(destination.place)) {
      refuse("A destination names a place that the map does not hold.", "destinations/" + destination.id.str());
    }
  }
}

void get_thumbnails(SQLite::Database& database, ContentDigest& digest, StoredMap& stored) {
  DigestedRows select(database, "SELECT image, jpeg FROM thumbnails ORDER BY image", digest);
  while (select.step()) {
    const SQLite::Column jpeg = select.column(1);
    const auto* first = static_cast<const std::uint8_t*>(jpeg.getBlob());
    stored.bytes += jpeg.getBytes();
    stored.thumbnails.emplace(ImageId(select.column(0).getString()),
                              std::vector<std::uint8_t>(first, first + jpeg.getBytes()));
  }
}

}  // namespace

void read_graph_part(SQLite::Database& database, map::TopologicalMap& map) {
  ContentDigest ignored;  // whoever keeps a part watches over its bytes
  map::TopologicalMap part;
  get_meta(database, ignored, part);
  get_graph(database, ignored, part);
  const auto same = [](const map::Place& a, const map::Place& b) { return a.id == b.id && a.prototype == b.prototype; };
  if (!std::ranges::equal(part.places, map.places, same)) refuse("The edits are of a map with other places.");
  for (std::size_t i = 0; i < map.places.size(); ++i) map.places[i].label = part.places[i].label;
  part.places = std::move(map.places);
  part.images = std::move(map.images);
  map = std::move(part);
  check_references(map);
}

MapContents read_contents(SQLite::Database& database) {
  ContentDigest digest;
  MapContents contents;
  map::TopologicalMap& map = contents.stored.map;
  get_meta(database, digest, map);
  get_images(database, digest, map);
  get_graph(database, digest, map);
  get_thumbnails(database, digest, contents.stored);
  check_references(map);
  contents.checksum = digest.hexadecimal();
  return contents;
}

}  // namespace homeward::db
