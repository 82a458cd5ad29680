// SPDX-License-Identifier: Apache-2.0
#include "db/sqlite/map_file_contents.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>

#include "db/sqlite/map_file_digest.hpp"
#include "db/sqlite/map_file_edits.hpp"
#include "db/sqlite/map_file_path.hpp"
#include "db/sqlite/map_file_schema.hpp"
#include "db/sqlite/map_file_state.hpp"
#include "map/state.hpp"
#include "wire/camera_json.hpp"

namespace homeward::db {
namespace {

using nlohmann::json;

std::optional<json> optional_meta(DigestedRows& entries, const std::string& key) {
  entries.restart(key);
  if (!entries.step()) return std::nullopt;
  return json::parse(entries.column(0).getString());
}

json meta(DigestedRows& entries, const std::string& key) {
  std::optional<json> found = optional_meta(entries, key);
  if (!found) refuse_file("The map file lacks the entry '" + key + "'.", "meta");
  return std::move(*found);
}

void get_meta(SQLite::Database& database, ContentDigest& digest, map::TopologicalMap& map) {
  DigestedRows entries(database, "SELECT value FROM meta WHERE key = ?", digest);
  map.version = meta(entries, "version").get<int>();
  map.name = meta(entries, "name").get<std::string>();
  map.revision = meta(entries, "revision").get<std::int64_t>();
  const Result<camera::CameraConfig> camera = wire::camera_from_json(meta(entries, "camera"));
  if (!camera) refuse_file("The map's camera cannot be: " + camera.error().message, "meta");
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
      refuse_file("The map's calibration of beliefs cannot be.", "meta");
    }
  }
  map.next_place_number = meta(entries, "next_place_number").get<std::int64_t>();
  map.next_destination_number = meta(entries, "next_destination_number").get<std::int64_t>();
  map.build_seconds = meta(entries, "build_seconds").get<double>();
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

/// Places and all that joins, names and edits them, and how it was without edits.
void get_graph(SQLite::Database& database, ContentDigest& digest, map::TopologicalMap& map) {
  if (file_version_of(database) < kFirstVersionWithStates) {
    get_state(database, MapState::kPresent, digest, nullptr, map);
    get_edits(database, digest, nullptr, map);
    map.settled_edits = map.edits.size();
    return;
  }
  const AppearanceReader appearances(database, digest);
  get_state(database, MapState::kPresent, digest, &appearances, map);
  get_edits(database, digest, &appearances, map);
  DigestedRows entries(database, "SELECT value FROM meta WHERE key = ?", digest);
  map.settled_edits = meta(entries, "settled_edits").get<std::size_t>();
  if (map.settled_edits > map.edits.size()) refuse_file("The map says more of its log than there is.", "meta");
  if (!meta(entries, "has_unedited").get<bool>()) return;
  map::TopologicalMap unedited;
  get_state(database, MapState::kUnedited, digest, &appearances, unedited);
  map.unedited = std::make_shared<const map::TopologicalMap>(std::move(unedited));
}

/// A map that points at places or images that it does not hold must not reach a robot.
void check_references(const map::TopologicalMap& map, const std::set<ImageId>& images) {
  std::set<PlaceId> places;
  for (const map::Place& place : map.places) {
    places.insert(place.id);
    const std::string where = "places/" + place.id.str();
    if (place.members.empty()) refuse_file("A place has no image.", where);
    if (place.appearances.empty()) refuse_file("A place has no appearance.", where);
    for (const ImageId& member : place.members) {
      if (!images.contains(member)) refuse_file("A place names an image that the map does not hold.", where);
    }
    if (!images.contains(place.prototype)) refuse_file("A place's prototype is not in the map.", where);
    if (std::ranges::find(place.members, place.prototype) == place.members.end()) {
      refuse_file("A place's prototype is none of its images.", where);
    }
  }
  for (const map::Edge& edge : map.edges) {
    if (!places.contains(edge.from) || !places.contains(edge.to)) {
      refuse_file("An edge names a place that the map does not hold.", "edges");
    }
  }
  for (const map::Shortcut& shortcut : map.shortcuts) {
    if (!images.contains(shortcut.image_a) || !images.contains(shortcut.image_b)) {
      refuse_file("A shortcut names an image that the map does not hold.", "shortcuts");
    }
  }
  for (const map::Destination& destination : map.destinations) {
    if (!places.contains(destination.place)) {
      refuse_file("A destination names a place that the map does not hold.", "destinations/" + destination.id.str());
    }
  }
}

void check_references(const map::TopologicalMap& map) {
  std::set<ImageId> images;
  for (const map::MapImage& image : map.images) images.insert(image.id);
  check_references(map, images);
  if (map.unedited) check_references(*map.unedited, images);
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
  // A part has no state without edits: that is the file's, or, where nothing had been edited, the file's as it is.
  part.unedited = map.unedited || part.edits.size() == part.settled_edits ? map.unedited : map::state_of(map);
  // Edits that the file has share its appearances; what they found out changes with a file alone.
  for (std::size_t i = 0; i < std::min(part.edits.size(), map.edits.size()); ++i) {
    part.edits[i].found.appearances = map.edits[i].found.appearances;
    part.edits[i].found.learnt = map.edits[i].found.learnt;
  }
  const auto same = [](const map::Place& a, const map::Place& b) { return a.id == b.id && a.prototype == b.prototype; };
  if (!std::ranges::equal(part.places, map.places, same)) refuse_file("The edits are of a map with other places.");
  for (std::size_t i = 0; i < map.places.size(); ++i) map.places[i].label = part.places[i].label;
  part.places = std::move(map.places);
  part.images = std::move(map.images);
  part.path = std::move(map.path);
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
  map.path = get_path(database, digest, map.images);
  get_thumbnails(database, digest, contents.stored);
  check_references(map);
  contents.checksum = digest.hexadecimal();
  return contents;
}

}  // namespace homeward::db
