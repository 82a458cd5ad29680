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
    if (key.scale) {
      insert.bind(7, key.scale->ratio);
      insert.bind(8, key.scale->common);
      insert.bind(9, key.scale->spread);
    }
    insert.exec();
    insert.reset();
    insert.clearBindings();
  }
}

std::optional<map::NodeScale> scale_of(DigestedRows& row, const std::string& where) {
  if (row.column(5).isNull()) return std::nullopt;
  map::NodeScale scale;
  scale.ratio = row.column(5).getDouble();
  scale.common = count_of(row.column(6), where);
  scale.spread = row.column(7).getDouble();
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
                      count_of(select.column(4), where), scale_of(select, where)};
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
    if (at(arc->from) + 1 >= taught.key_images.size()) refuse_file("An arc of the path leads nowhere.", where);
    if (!taught.arcs.empty() && arc->from <= taught.arcs.back().from) {
      refuse_file("The arcs of the path are not in order.", where);
    }
    taught.arcs.push_back(*std::move(arc));
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
  get_key_images(database, digest, images, path);
  get_arcs(database, digest, path.taught);
  get_gaps(database, digest, images, path.taught);
  if (path.images.empty()) {
    if (!path.taught.cuts.empty()) refuse_file("The map has cuts of a path that it does not have.", "path");
    return nullptr;
  }
  return std::make_shared<const map::MapPath>(std::move(path));
}

}  // namespace homeward::db
