// SPDX-License-Identifier: Apache-2.0
#include "db/sqlite/map_file_path.hpp"

#include <cmath>
#include <limits>
#include <set>
#include <span>
#include <string>

#include "core/index.hpp"
#include "db/sqlite/map_file_failure.hpp"
#include "db/sqlite/map_file_schema.hpp"
#include "wire/path_blob.hpp"

namespace homeward::db {
namespace {

void bind_bytes(SQLite::Statement& statement, int index, const std::vector<std::uint8_t>& bytes) {
  statement.bind(index, bytes.data(), static_cast<int>(bytes.size()));
}

std::span<const std::uint8_t> bytes_of(const SQLite::Column& column) {
  return {static_cast<const std::uint8_t*>(column.getBlob()), static_cast<std::size_t>(column.getBytes())};
}

/// A number of a picture that was shown, or of a thing of the path.
int count_of(const SQLite::Column& column, const std::string& where) {
  const std::int64_t value = column.getInt64();
  if (value < 0 || value > std::numeric_limits<int>::max()) refuse_file("A number of the path cannot be.", where);
  return static_cast<int>(value);
}

/// The number of a picture that was shown: the map has all of them.
int shown_of(const SQLite::Column& column, const std::vector<map::MapImage>& images, const std::string& where) {
  const int shown = count_of(column, where);
  if (at(shown) >= images.size()) refuse_file("The path names a picture that the map does not hold.", where);
  return shown;
}

void bind_scale(SQLite::Statement& statement, int index, const std::optional<map::NodeScale>& scale) {
  if (!scale) return;
  statement.bind(index, scale->ratio);
  statement.bind(index + 1, scale->common);
  statement.bind(index + 2, scale->spread);
}

void put_key_images(SQLite::Database& database, const map::MapPath& path) {
  SQLite::Statement insert(database, "INSERT INTO path_key_images VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)");
  for (std::size_t i = 0; i < path.taught.key_images.size(); ++i) {
    const map::KeyImage& key = path.taught.key_images[i];
    const std::vector<std::uint8_t> features = wire::encode_key_features(key.features);
    insert.bind(1, static_cast<std::int64_t>(i));
    insert.bind(2, path.images.at(i).str());
    insert.bind(3, key.picture);
    bind_bytes(insert, 4, path.pictures.at(i));
    bind_bytes(insert, 5, features);
    insert.bind(6, key.common);
    bind_scale(insert, 7, key.scale);
    insert.exec();
    insert.reset();
    insert.clearBindings();
  }
}

void put_bridges_and_closing(SQLite::Database& database, const map::TaughtPath& taught) {
  SQLite::Statement bridges(database, "INSERT INTO path_bridges VALUES (?, ?, ?, ?)");
  for (std::size_t i = 0; i < taught.bridges.size(); ++i) {
    bridges.bind(1, static_cast<std::int64_t>(i));
    bridges.bind(2, taught.bridges[i].last_picture);
    bridges.bind(3, taught.bridges[i].next_picture);
    bridges.bind(4, taught.bridges[i].matched);
    bridges.exec();
    bridges.reset();
  }
  if (!taught.closing) return;
  SQLite::Statement closing(database, "INSERT INTO path_closing VALUES (0, ?, ?, ?, ?, ?)");
  closing.bind(1, taught.closing->key_image);
  closing.bind(2, taught.closing->common);
  bind_scale(closing, 3, taught.closing->scale);
  closing.exec();
}

/// A scale in three columns from one on.
std::optional<map::NodeScale> scale_of(DigestedRows& row, int column, const std::string& where) {
  if (row.column(column).isNull()) return std::nullopt;
  map::NodeScale scale;
  scale.ratio = row.column(column).getDouble();
  scale.common = count_of(row.column(column + 1), where);
  scale.spread = row.column(column + 2).getDouble();
  if (!(scale.ratio > 0.0) || !std::isfinite(scale.ratio) || !(scale.spread >= 0.0)) {
    refuse_file("The scale of a key image of the path cannot be.", where);
  }
  return scale;
}

void get_key_images(SQLite::Database& database, ContentDigest& digest, const std::vector<map::MapImage>& images,
                    map::MapPath& path) {
  std::set<ImageId> known;
  for (const map::MapImage& image : images) known.insert(image.id);
  DigestedRows select(database,
                      "SELECT image, shown, picture, features, common, scale_ratio, scale_common, scale_spread "
                      "FROM path_key_images ORDER BY position",
                      digest);
  while (select.step()) {
    const std::string where = "path/" + std::to_string(path.images.size());
    ImageId image(select.column(0).getString());
    if (!known.contains(image)) refuse_file("The path names an image that the map does not hold.", where);
    auto features = wire::decode_key_features(bytes_of(select.column(3)), where);
    if (!features) throw LoadFailure(features.error());
    const auto picture = bytes_of(select.column(2));
    if (picture.empty()) refuse_file("A key image of the path has no picture.", where);
    map::KeyImage key{shown_of(select.column(1), images, where), *std::move(features),
                      count_of(select.column(4), where), scale_of(select, 5, where)};
    if (!path.taught.key_images.empty() && key.picture <= path.taught.key_images.back().picture) {
      refuse_file("The key images of the path are not in the order in which they were shown.", where);
    }
    path.taught.key_images.push_back(std::move(key));
    path.images.push_back(std::move(image));
    path.pictures.emplace_back(picture.begin(), picture.end());
  }
}

void get_arcs(SQLite::Database& database, ContentDigest& digest, map::TaughtPath& taught) {
  DigestedRows select(database, "SELECT from_key_image, arc FROM path_arcs ORDER BY position", digest);
  while (select.step()) {
    const std::string where = "path/arcs/" + std::to_string(taught.arcs.size());
    auto arc = wire::decode_arc(bytes_of(select.column(1)), where);
    if (!arc) throw LoadFailure(arc.error());
    arc->from = count_of(select.column(0), where);
    const bool leads = arc->from < taught.last_key() || (arc->from == taught.last_key() && taught.closing);
    if (!leads) refuse_file("An arc of the path leads nowhere.", where);
    if (!taught.arcs.empty() && arc->from <= taught.arcs.back().from) {
      refuse_file("The arcs of the path are not in order.", where);
    }
    taught.arcs.push_back(*std::move(arc));
  }
}

/// Where a closed path goes on; before its arcs.
void get_closing(SQLite::Database& database, ContentDigest& digest, map::TaughtPath& taught) {
  const std::string where = "path/closing";
  DigestedRows select(database, "SELECT key_image, common, scale_ratio, scale_common, scale_spread FROM path_closing",
                      digest);
  if (!select.step()) return;
  map::PathClosing closing;
  closing.key_image = count_of(select.column(0), where);
  closing.common = count_of(select.column(1), where);
  closing.scale = scale_of(select, 2, where);
  if (closing.key_image >= taught.last_key()) refuse_file("The path is closed where it ends.", where);
  taught.closing = closing;
}

/// Whether a closed path leads in one piece from where it is closed to its end and on from there.
void check_closing(const map::TaughtPath& taught) {
  if (!taught.closing) return;
  for (int key = taught.closing->key_image; key <= taught.last_key(); ++key) {
    if (!taught.arc_from(key)) refuse_file("The path is closed and does not lead round.", "path/closing");
  }
}

void get_bridges(SQLite::Database& database, ContentDigest& digest, const std::vector<map::MapImage>& images,
                 map::TaughtPath& taught) {
  DigestedRows select(database, "SELECT last_shown, next_shown, matched FROM path_bridges ORDER BY position", digest);
  while (select.step()) {
    const std::string where = "path/bridges/" + std::to_string(taught.bridges.size());
    const map::PathBridge bridge{shown_of(select.column(0), images, where), shown_of(select.column(1), images, where),
                                 count_of(select.column(2), where)};
    if (bridge.next_picture <= bridge.last_picture) refuse_file("A bridge of the path leads back.", where);
    taught.bridges.push_back(bridge);
  }
}

void get_gaps(SQLite::Database& database, ContentDigest& digest, const std::vector<map::MapImage>& images,
              map::TaughtPath& taught) {
  DigestedRows cuts(database, "SELECT last_shown, next_shown, why FROM path_cuts ORDER BY position", digest);
  while (cuts.step()) {
    const std::string where = "path/cuts/" + std::to_string(taught.cuts.size());
    map::PathCut cut;
    cut.last_picture = shown_of(cuts.column(0), images, where);
    if (!cuts.column(1).isNull()) cut.next_picture = shown_of(cuts.column(1), images, where);
    const int why = count_of(cuts.column(2), where);
    if (why > static_cast<int>(map::CutReason::kErrorTooLarge)) {
      refuse_file("The path is cut for a reason that this program does not know.", where);
    }
    cut.why = static_cast<map::CutReason>(why);
    taught.cuts.push_back(cut);
  }
  DigestedRows skipped(database, "SELECT shown FROM path_skipped ORDER BY position", digest);
  while (skipped.step()) {
    taught.skipped_pictures.push_back(shown_of(skipped.column(0), images, "path/skipped"));
  }
}

}  // namespace

void put_path(SQLite::Database& database, const map::MapPath& path) {
  put_key_images(database, path);
  put_bridges_and_closing(database, path.taught);
  SQLite::Statement arcs(database, "INSERT INTO path_arcs VALUES (?, ?, ?)");
  for (std::size_t i = 0; i < path.taught.arcs.size(); ++i) {
    const std::vector<std::uint8_t> bytes = wire::encode_arc(path.taught.arcs[i]);
    arcs.bind(1, static_cast<std::int64_t>(i));
    arcs.bind(2, path.taught.arcs[i].from);
    bind_bytes(arcs, 3, bytes);
    arcs.exec();
    arcs.reset();
  }
  SQLite::Statement cuts(database, "INSERT INTO path_cuts VALUES (?, ?, ?, ?)");
  for (std::size_t i = 0; i < path.taught.cuts.size(); ++i) {
    const map::PathCut& cut = path.taught.cuts[i];
    cuts.bind(1, static_cast<std::int64_t>(i));
    cuts.bind(2, cut.last_picture);
    if (cut.next_picture) cuts.bind(3, *cut.next_picture);
    cuts.bind(4, static_cast<int>(cut.why));
    cuts.exec();
    cuts.reset();
    cuts.clearBindings();
  }
  SQLite::Statement skipped(database, "INSERT INTO path_skipped VALUES (?, ?)");
  for (std::size_t i = 0; i < path.taught.skipped_pictures.size(); ++i) {
    skipped.bind(1, static_cast<std::int64_t>(i));
    skipped.bind(2, path.taught.skipped_pictures[i]);
    skipped.exec();
    skipped.reset();
  }
}

std::shared_ptr<const map::MapPath> get_path(SQLite::Database& database, ContentDigest& digest,
                                             const std::vector<map::MapImage>& images) {
  if (file_version_of(database) < kFirstVersionWithPaths) return nullptr;
  map::MapPath path;
  const bool knows_bridges = file_version_of(database) >= kFirstVersionWithBridges;
  get_key_images(database, digest, images, path);
  if (knows_bridges) get_closing(database, digest, path.taught);
  get_arcs(database, digest, path.taught);
  check_closing(path.taught);
  get_gaps(database, digest, images, path.taught);
  if (knows_bridges) get_bridges(database, digest, images, path.taught);
  if (path.images.empty()) {
    if (!path.taught.cuts.empty()) refuse_file("The map has cuts of a path that it does not have.", "path");
    return nullptr;
  }
  return std::make_shared<const map::MapPath>(std::move(path));
}

}  // namespace homeward::db
