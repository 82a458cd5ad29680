// SPDX-License-Identifier: Apache-2.0
#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>

#include "db/map_file.hpp"
#include "db/sqlite/map_file_schema.hpp"
#include "wire/appearance_blob.hpp"
#include "wire/camera_json.hpp"

namespace homeward::db {
namespace {

using nlohmann::json;

/// Carries an Error through the reading functions to load_map.
struct LoadFailure : std::runtime_error {
  explicit LoadFailure(Error failure) : std::runtime_error(failure.message), error(std::move(failure)) {}
  Error error;
};

[[noreturn]] void refuse(std::string message, std::string where = {}) {
  throw LoadFailure({ErrorCode::kCorruptFile, std::move(message), std::move(where)});
}

std::optional<json> optional_meta(SQLite::Database& database, const std::string& key) {
  SQLite::Statement select(database, "SELECT value FROM meta WHERE key = ?");
  select.bind(1, key);
  if (!select.executeStep()) return std::nullopt;
  return json::parse(select.getColumn(0).getString());
}

json meta(SQLite::Database& database, const std::string& key) {
  std::optional<json> found = optional_meta(database, key);
  if (!found) refuse("The map file lacks the entry '" + key + "'.", "meta");
  return std::move(*found);
}

void get_meta(SQLite::Database& database, map::TopologicalMap& map) {
  map.version = meta(database, "version").get<int>();
  map.name = meta(database, "name").get<std::string>();
  map.revision = meta(database, "revision").get<std::int64_t>();
  const Result<camera::CameraConfig> camera = wire::camera_from_json(meta(database, "camera"));
  if (!camera) throw LoadFailure(camera.error());
  map.camera = *camera;
  const json features = meta(database, "feature_config");
  map.feature_config.panorama_width_px = features.at("panorama_width_px").get<int>();
  map.feature_config.elevation_max_rad = features.at("elevation_max_rad").get<double>();
  map.feature_config.elevation_min_rad = features.at("elevation_min_rad").get<double>();
  map.feature_config.max_sift = features.at("max_sift").get<int>();
  map.feature_config.sift_contrast_threshold = features.at("sift_contrast_threshold").get<double>();
  map.feature_config.sift_code_length = features.at("sift_code_length").get<int>();
  map.feature_config.sift_windows = features.value("sift_windows", 1);  // files of before have one
  map.feature_config.max_columns = features.at("max_columns").get<int>();
  map.feature_config_id = meta(database, "feature_config_id").get<std::string>();
  const json motion = meta(database, "motion");
  map.motion.hop_spread = motion.at("hop_spread").get<double>();
  map.motion.distance_spread = motion.at("distance_spread").get<double>();
  map.motion.distance_scale = motion.at("distance_scale").get<double>();
  // Files of before have none: the defaults serve.
  if (const auto calibration = optional_meta(database, "calibration")) {
    map.calibration.offset = calibration->at("offset").get<double>();
    map.calibration.slope = calibration->at("slope").get<double>();
    if (!std::isfinite(map.calibration.offset) || !(map.calibration.slope > 0.0)) {
      refuse("The map's calibration of beliefs cannot be.", "meta");
    }
  }
  map.next_place_number = meta(database, "next_place_number").get<std::int64_t>();
  map.next_destination_number = meta(database, "next_destination_number").get<std::int64_t>();
  map.build_seconds = meta(database, "build_seconds").get<double>();
}

std::optional<double> optional_number(const SQLite::Column& column) {
  return column.isNull() ? std::nullopt : std::optional(column.getDouble());
}

void get_images(SQLite::Database& database, map::TopologicalMap& map) {
  SQLite::Statement select(
      database, "SELECT id, t_us, odometry_x_m, odometry_y_m, odometry_theta_rad FROM images ORDER BY position");
  while (select.executeStep()) {
    map::MapImage image{ImageId(select.getColumn(0).getString()), {}, {}};
    if (!select.getColumn(1).isNull()) image.t_us = select.getColumn(1).getInt64();
    if (!select.getColumn(2).isNull()) {
      image.odometry =
          Pose2{select.getColumn(2).getDouble(), select.getColumn(3).getDouble(), select.getColumn(4).getDouble()};
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

void get_places(SQLite::Database& database, map::TopologicalMap& map) {
  SQLite::Statement places(database, "SELECT id, label, prototype FROM places ORDER BY position");
  SQLite::Statement members(database, "SELECT image FROM place_members WHERE place = ? ORDER BY position");
  SQLite::Statement appearances(database, "SELECT appearance FROM place_appearances WHERE place = ? ORDER BY position");
  while (places.executeStep()) {
    map::Place place;
    const std::string id = places.getColumn(0).getString();
    place.id = PlaceId(id);
    place.label = places.getColumn(1).getString();
    place.prototype = ImageId(places.getColumn(2).getString());
    members.reset();
    members.bind(1, id);
    while (members.executeStep()) place.members.emplace_back(members.getColumn(0).getString());
    appearances.reset();
    appearances.bind(1, id);
    while (appearances.executeStep()) {
      place.appearances.push_back(get_appearance(appearances.getColumn(0), "places/" + id));
    }
    map.places.push_back(std::move(place));
  }
}

/// Files of version 2 do not say where lengths come from: metres where every image has odometry, else images.
map::LengthSource old_length_source(const map::TopologicalMap& map, const map::Edge& edge) {
  if (edge.by == "person") return map::LengthSource::kUnknown;
  const bool metric = std::all_of(map.images.begin(), map.images.end(),
                                  [](const map::MapImage& image) { return image.odometry.has_value(); });
  return metric ? map::LengthSource::kOdometry : map::LengthSource::kTourImages;
}

void get_edges(SQLite::Database& database, map::TopologicalMap& map) {
  const bool tells_source = database.execAndGet("PRAGMA user_version").getInt() >= 3;
  SQLite::Statement select(database,
                           std::string("SELECT from_place, to_place, bearing_rad, turn_rad, length_m, confidence, "
                                       "weak, blocked, by") +
                               (tells_source ? ", length_from, inliers" : "") + " FROM edges ORDER BY position");
  while (select.executeStep()) {
    map::Edge edge;
    edge.from = PlaceId(select.getColumn(0).getString());
    edge.to = PlaceId(select.getColumn(1).getString());
    edge.bearing_rad = optional_number(select.getColumn(2));
    edge.turn_rad = optional_number(select.getColumn(3));
    edge.length_m = select.getColumn(4).getDouble();
    edge.confidence = select.getColumn(5).getDouble();
    edge.weak = select.getColumn(6).getInt() != 0;
    edge.blocked = select.getColumn(7).getInt() != 0;
    edge.by = select.getColumn(8).getString();
    edge.length_from = old_length_source(map, edge);
    if (tells_source) {
      const int source = select.getColumn(9).getInt();
      if (source < 0 || source > static_cast<int>(map::LengthSource::kTourImages)) {
        refuse("An edge has a length from an unknown source.", "edges");
      }
      edge.length_from = static_cast<map::LengthSource>(source);
      edge.inliers = select.getColumn(10).getInt();
    }
    map.edges.push_back(std::move(edge));
  }
}

map::Masses get_masses(SQLite::Statement& select, int first_column) {
  return {select.getColumn(first_column).getDouble(), select.getColumn(first_column + 1).getDouble(),
          select.getColumn(first_column + 2).getDouble()};
}

void get_hypotheses(SQLite::Database& database, map::TopologicalMap& map) {
  SQLite::Statement select(database,
                           "SELECT prototype_a, prototype_b, similarity, before_true, before_false, before_unknown, "
                           "after_true, after_false, after_unknown, support, plausibility, decision, by "
                           "FROM hypotheses ORDER BY position");
  while (select.executeStep()) {
    map::Hypothesis hypothesis;
    hypothesis.prototype_a = ImageId(select.getColumn(0).getString());
    hypothesis.prototype_b = ImageId(select.getColumn(1).getString());
    hypothesis.similarity = select.getColumn(2).getDouble();
    hypothesis.masses_before = get_masses(select, 3);
    hypothesis.masses_after = get_masses(select, 6);
    hypothesis.support = select.getColumn(9).getDouble();
    hypothesis.plausibility = select.getColumn(10).getDouble();
    const int decision = select.getColumn(11).getInt();
    if (decision < 0 || decision > static_cast<int>(map::Decision::kUndecided)) {
      refuse("A hypothesis has an unknown decision.", "hypotheses");
    }
    hypothesis.decision = static_cast<map::Decision>(decision);
    hypothesis.by = select.getColumn(12).getString();
    map.hypotheses.push_back(std::move(hypothesis));
  }
}

void get_destinations(SQLite::Database& database, map::TopologicalMap& map) {
  SQLite::Statement select(database, "SELECT id, place, image, label, appearance FROM destinations ORDER BY position");
  while (select.executeStep()) {
    map::Destination destination;
    destination.id = DestinationId(select.getColumn(0).getString());
    destination.place = PlaceId(select.getColumn(1).getString());
    destination.image = ImageId(select.getColumn(2).getString());
    destination.label = select.getColumn(3).getString();
    destination.appearance = get_appearance(select.getColumn(4), "destinations/" + destination.id.str());
    map.destinations.push_back(std::move(destination));
  }
}

void get_edits(SQLite::Database& database, map::TopologicalMap& map) {
  SQLite::Statement select(
      database, "SELECT kind, image_a, image_b, text, images_json, by, t_us, undone FROM edits ORDER BY position");
  while (select.executeStep()) {
    map::Edit edit;
    const int kind = select.getColumn(0).getInt();
    if (kind < 0 || kind > static_cast<int>(map::EditKind::kDecide)) refuse("An edit has an unknown kind.", "edits");
    edit.kind = static_cast<map::EditKind>(kind);
    edit.image_a = ImageId(select.getColumn(1).getString());
    edit.image_b = ImageId(select.getColumn(2).getString());
    edit.text = select.getColumn(3).getString();
    for (const json& image : json::parse(select.getColumn(4).getString())) {
      edit.images.emplace_back(image.get<std::string>());
    }
    edit.by = select.getColumn(5).getString();
    edit.t_us = select.getColumn(6).getInt64();
    edit.undone = select.getColumn(7).getInt() != 0;
    map.edits.push_back(std::move(edit));
  }
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
  for (const map::Destination& destination : map.destinations) {
    if (!places.contains(destination.place)) {
      refuse("A destination names a place that the map does not hold.", "destinations/" + destination.id.str());
    }
  }
}

void check_kind_and_version(SQLite::Database& database) {
  const int application_id = database.execAndGet("PRAGMA application_id").getInt();
  if (application_id != kMapApplicationId) refuse("This SQLite file is not a Homeward map.");
  const int version = database.execAndGet("PRAGMA user_version").getInt();
  if (version < kOldestMapFileVersion || version > kMapFileVersion) {
    throw LoadFailure({ErrorCode::kUnsupportedFormat,
                       "The map file has version " + std::to_string(version) + "; this program reads versions " +
                           std::to_string(kOldestMapFileVersion) + " to " + std::to_string(kMapFileVersion) +
                           ". Rebuild the map from the kept images.",
                       ""});
  }
}

StoredMap read_database(const std::filesystem::path& file) {
  SQLite::Database database(file.string(), SQLite::OPEN_READONLY);
  check_kind_and_version(database);
  // SQLite takes what is missing of its last page for zeros.
  const std::int64_t pages = database.execAndGet("PRAGMA page_count").getInt64();
  const std::int64_t whole_bytes = pages * database.execAndGet("PRAGMA page_size").getInt64();
  const auto bytes = static_cast<std::int64_t>(std::filesystem::file_size(file));
  if (bytes < whole_bytes) refuse("The map file ends early: copy it again.");
  StoredMap stored;
  get_meta(database, stored.map);
  get_images(database, stored.map);
  get_places(database, stored.map);
  get_edges(database, stored.map);
  get_hypotheses(database, stored.map);
  get_destinations(database, stored.map);
  get_edits(database, stored.map);
  check_references(stored.map);
  std::int64_t thumbnail_bytes = 0;
  SQLite::Statement thumbnails(database, "SELECT image, jpeg FROM thumbnails ORDER BY image");
  while (thumbnails.executeStep()) {
    const SQLite::Column jpeg = thumbnails.getColumn(1);
    const auto* first = static_cast<const std::uint8_t*>(jpeg.getBlob());
    thumbnail_bytes += jpeg.getBytes();
    stored.thumbnails.emplace(ImageId(thumbnails.getColumn(0).getString()),
                              std::vector<std::uint8_t>(first, first + jpeg.getBytes()));
  }
  stored.bytes = bytes - thumbnail_bytes;
  return stored;
}

}  // namespace

Result<StoredMap> load_map(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) {
    return fail(ErrorCode::kNotFound, "There is no map file of this name.", file.string());
  }
  try {
    return read_database(file);
  } catch (LoadFailure& failure) {
    Error error = std::move(failure.error);
    error.where = error.where.empty() ? file.string() : file.string() + ": " + error.where;
    return tl::unexpected<Error>(std::move(error));
  } catch (const std::exception& failure) {
    return fail(ErrorCode::kCorruptFile, std::string("The map file cannot be read: ") + failure.what() + ".",
                file.string());
  }
}

}  // namespace homeward::db
