// SPDX-License-Identifier: Apache-2.0
#include <SQLiteCpp/SQLiteCpp.h>
#include <fcntl.h>
#include <sqlite3.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <system_error>

#include "db/map_file.hpp"
#include "db/sqlite/durable_file.hpp"
#include "db/sqlite/failure_words.hpp"
#include "db/sqlite/map_file_contents.hpp"
#include "db/sqlite/map_file_edits.hpp"
#include "db/sqlite/map_file_path.hpp"
#include "db/sqlite/map_file_schema.hpp"
#include "db/sqlite/map_file_state.hpp"
#include "db/sqlite/map_graph_part.hpp"
#include "wire/camera_json.hpp"

namespace homeward::db {
namespace {

using nlohmann::json;

void put_meta(SQLite::Database& database, const map::TopologicalMap& map) {
  SQLite::Statement insert(database, "INSERT INTO meta(key, value) VALUES (?, ?)");
  const auto put = [&](const std::string& key, const json& value) {
    insert.bind(1, key);
    insert.bind(2, value.dump());
    insert.exec();
    insert.reset();
  };
  put("version", map.version);
  put("name", map.name);
  put("revision", map.revision);
  put("camera", wire::camera_to_json(map.camera));
  const features::FeatureConfig& features = map.feature_config;
  put("feature_config", {{"panorama_width_px", features.panorama_width_px},
                         {"elevation_max_rad", features.elevation_max_rad},
                         {"elevation_min_rad", features.elevation_min_rad},
                         {"max_sift", features.max_sift},
                         {"sift_contrast_threshold", features.sift_contrast_threshold},
                         {"sift_code_length", features.sift_code_length},
                         {"sift_windows", features.sift_windows},
                         {"max_columns", features.max_columns}});
  put("feature_config_id", map.feature_config_id);
  put("motion", {{"hop_spread", map.motion.hop_spread},
                 {"distance_spread", map.motion.distance_spread},
                 {"distance_scale", map.motion.distance_scale}});
  put("calibration", {{"offset", map.calibration.offset}, {"slope", map.calibration.slope}});
  put("next_place_number", map.next_place_number);
  put("next_destination_number", map.next_destination_number);
  put("build_seconds", map.build_seconds);
  put("settled_edits", map.settled_edits);
  put("has_unedited", map.unedited != nullptr);
}

void bind_optional(SQLite::Statement& statement, int index, const std::optional<double>& value) {
  if (value) {
    statement.bind(index, *value);
  } else {
    statement.bind(index);
  }
}

void put_images(SQLite::Database& database, const map::TopologicalMap& map) {
  SQLite::Statement insert(database, "INSERT INTO images VALUES (?, ?, ?, ?, ?, ?)");
  std::int64_t position = 0;
  for (const map::MapImage& image : map.images) {
    insert.bind(1, position++);
    insert.bind(2, image.id.str());
    if (image.t_us) {
      insert.bind(3, *image.t_us);
    } else {
      insert.bind(3);
    }
    bind_optional(insert, 4, image.odometry ? std::optional(image.odometry->x_m) : std::nullopt);
    bind_optional(insert, 5, image.odometry ? std::optional(image.odometry->y_m) : std::nullopt);
    bind_optional(insert, 6, image.odometry ? std::optional(image.odometry->theta_rad) : std::nullopt);
    insert.exec();
    insert.reset();
  }
}

void bind_blob(SQLite::Statement& statement, int index, const std::vector<std::uint8_t>& bytes) {
  statement.bind(index, bytes.data(), static_cast<int>(bytes.size()));
}

void put_thumbnails(SQLite::Database& database, const Thumbnails& thumbnails) {
  SQLite::Statement insert(database, "INSERT INTO thumbnails VALUES (?, ?)");
  for (const auto& [image, jpeg] : thumbnails) {
    insert.bind(1, image.str());
    bind_blob(insert, 2, jpeg);
    insert.exec();
    insert.reset();
  }
}

/// What edits change, and the places that it is about.
void put_graph(SQLite::Database& database, const map::TopologicalMap& map, AppearanceWriter& appearances) {
  put_meta(database, map);
  put_state(database, MapState::kPresent, map);
  put_edits(database, map, appearances);
}

/// All of it in memory: a build that is killed leaves no journal behind.
void fill_database(SQLite::Database& database, const map::TopologicalMap& map, const Thumbnails& thumbnails) {
  database.exec(
      "PRAGMA page_size = 1024");  // an appearance's last page is half empty: of 4096 bytes that is 2 kB a place
  database.exec("PRAGMA foreign_keys = ON");
  SQLite::Transaction transaction(database);
  database.exec(map_file_schema());
  database.exec("PRAGMA application_id = " + std::to_string(kMapApplicationId));
  database.exec("PRAGMA user_version = " + std::to_string(kMapFileVersion));
  AppearanceWriter appearances(database);
  put_images(database, map);
  put_graph(database, map, appearances);
  put_what_places_hold(database, MapState::kPresent, map, appearances);
  if (map.unedited) {
    put_state(database, MapState::kUnedited, *map.unedited);
    put_what_places_hold(database, MapState::kUnedited, *map.unedited, appearances);
  }
  if (map.path) put_path(database, *map.path);
  put_thumbnails(database, thumbnails);
  SQLite::Statement checksum(database, kInsertChecksum);
  checksum.bind(1, read_contents(database).checksum);
  checksum.exec();
  transaction.commit();
}

[[noreturn]] void throw_errno(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

/// The unfinished file beside a map. It has one name for all who write this map, so that what a killed program left is
/// taken over and not added to; a lock on it makes them wait for each other.
class PartFile {
 public:
  explicit PartFile(std::filesystem::path path) : path_(std::move(path)) {
    while (!open_locked()) {
    }
    if (::ftruncate(descriptor_, 0) != 0) throw_errno("emptying the unfinished file");
  }
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;
  ~PartFile() {
    if (!renamed_) ::unlink(path_.c_str());
    ::close(descriptor_);
  }

  void write(std::span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
      const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) throw_errno("writing");
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    if (::fsync(descriptor_) != 0) throw_errno("bringing it to the disk");
  }

  void rename_to(const std::filesystem::path& file) {
    if (::rename(path_.c_str(), file.c_str()) != 0) throw_errno("putting it in place");
    renamed_ = true;
  }

 private:
  /// False when the one who had the lock before has renamed or removed the file meanwhile.
  bool open_locked() {
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644);
    if (descriptor_ < 0) throw_errno("making the unfinished file");
    while (::flock(descriptor_, LOCK_EX) != 0) {
      if (errno == EINTR) continue;
      if (errno == ENOLCK || errno == EOPNOTSUPP) break;  // a file system without locks: then without
      ::close(descriptor_);
      throw_errno("locking the unfinished file");
    }
    struct stat held {};
    struct stat named {};
    const bool same = ::fstat(descriptor_, &held) == 0 && ::stat(path_.c_str(), &named) == 0 &&
                      held.st_ino == named.st_ino && held.st_dev == named.st_dev;
    if (!same) ::close(descriptor_);
    return same;
  }

  std::filesystem::path path_;
  int descriptor_ = -1;
  bool renamed_ = false;
};

struct Serialized {
  std::unique_ptr<unsigned char, decltype(&sqlite3_free)> bytes;
  sqlite3_int64 count = 0;
  [[nodiscard]] std::span<const std::uint8_t> all() const { return {bytes.get(), static_cast<std::size_t>(count)}; }
};

Serialized serialized(SQLite::Database& database) {
  sqlite3_int64 count = 0;
  Serialized all{{sqlite3_serialize(database.getHandle(), "main", &count, 0), &sqlite3_free}, 0};
  if (!all.bytes) throw std::bad_alloc();
  all.count = count;
  return all;
}

void write_file(const std::filesystem::path& file, SQLite::Database& database) {
  const Serialized all = serialized(database);
  std::filesystem::path part = file;
  part += ".part";
  PartFile unfinished(part);
  unfinished.write(all.all());
  unfinished.rename_to(file);
}

/// A rename is on the disk only when its folder is.
bool folder_flushed(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool flushed = ::fsync(descriptor) == 0;
  ::close(descriptor);
  return flushed;
}

}  // namespace

std::vector<std::uint8_t> graph_part_of(const map::TopologicalMap& map) {
  SQLite::Database database(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  SQLite::Transaction transaction(database);
  database.exec(map_file_schema());
  database.exec("PRAGMA user_version = " + std::to_string(kMapFileVersion));
  AppearanceWriter appearances(database);
  put_graph(database, map, appearances);
  transaction.commit();
  const Serialized all = serialized(database);
  return {all.all().begin(), all.all().end()};
}

Status save_map(const std::filesystem::path& file, const map::TopologicalMap& map, const Thumbnails& thumbnails) {
  std::filesystem::path folder = file.parent_path();
  if (folder.empty()) folder = ".";
  try {
    SQLite::Database database(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    fill_database(database, map, thumbnails);
    write_file(file, database);
  } catch (const std::system_error& failure) {
    if (is_disk_full(failure.code())) return tl::unexpected<Error>(disk_full(file.string()));
    return fail(ErrorCode::kIo, "The map could not be written: " + words_of(failure) + ".", file.string());
  } catch (const std::exception& failure) {
    return fail(ErrorCode::kIo, "The map could not be written: " + words_of(failure) + ".", file.string());
  }
  if (!folder_flushed(folder)) {
    return fail(ErrorCode::kIo, "The map's folder could not be flushed to the disk.", folder.string());
  }
  return {};
}

}  // namespace homeward::db
