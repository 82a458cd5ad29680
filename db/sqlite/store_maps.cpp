// SPDX-License-Identifier: Apache-2.0
#include <set>

#include "db/secrets.hpp"
#include "db/sqlite/durable_file.hpp"
#include "db/sqlite/sqlite_store.hpp"

namespace homeward::db {
namespace {

constexpr const char* kMaps =
    "SELECT id, name, state, revision, places, images, feature_config_id, created_us, refine FROM maps "
    "ORDER BY created_us, rowid";
constexpr const char* kOneMap =
    "SELECT id, name, state, revision, places, images, feature_config_id, created_us, refine FROM maps WHERE id = ?";

MapRecord map_of(SQLite::Database& database, SQLite::Statement& row) {
  MapRecord map;
  map.id = MapId(text(row, 0));
  map.name = text(row, 1);
  const std::optional<wire::MapState> state = wire::map_state(text(row, 2));
  if (!state) refuse(ErrorCode::kCorruptFile, "The database holds an unknown state.", "maps/" + map.id.str());
  map.state = *state;
  map.revision = integer(row, 3);
  map.places = integer(row, 4);
  map.images = integer(row, 5);
  map.feature_config_id = optional_text(row, 6);
  map.created_us = integer(row, 7);
  const std::optional<wire::RefineMode> refine = wire::refine_mode(text(row, 8));
  if (!refine) refuse(ErrorCode::kCorruptFile, "The database holds an unknown setting.", "maps/" + map.id.str());
  map.refine = *refine;
  SQLite::Statement tour = prepared(database, "SELECT tour FROM map_tours WHERE map = ? ORDER BY position", map.id);
  while (tour.executeStep()) map.tours.emplace_back(text(tour, 0));
  return map;
}

MapRecord need_map(SQLite::Database& database, const MapId& id) {
  SQLite::Statement row = prepared(database, kOneMap, id);
  if (!row.executeStep()) refuse(ErrorCode::kNotFound, "There is no map with this id.", "maps/" + id.str());
  return map_of(database, row);
}

void insert_tours(SQLite::Database& database, const MapId& map, const std::vector<TourId>& tours,
                  std::size_t position) {
  for (const TourId& tour : tours) {
    if (!prepared(database, "SELECT id FROM tours WHERE id = ?", tour).executeStep()) {
      refuse(ErrorCode::kNotFound, "There is no tour with this id.", "tours/" + tour.str());
    }
    execute(database, "INSERT INTO map_tours (map, position, tour) VALUES (?, ?, ?)", map, position++, tour);
  }
}

MapRecord insert_map(SQLite::Database& database, const MapRecord& map) {
  execute(database,
          "INSERT INTO maps (id, name, state, revision, places, images, feature_config_id, created_us, refine) "
          "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)",
          map.id, map.name, std::string(wire::map_state_name(map.state)), map.revision, map.places, map.images,
          map.feature_config_id, map.created_us, std::string(wire::refine_mode_name(map.refine)));
  insert_tours(database, map.id, map.tours, 0);
  return map;
}

void describe(MapRecord& record, const map::TopologicalMap& contents) {
  record.state = wire::MapState::kReady;
  record.revision = contents.revision;
  record.places = static_cast<std::int64_t>(contents.places.size());
  record.images = static_cast<std::int64_t>(contents.images.size());
  record.feature_config_id = contents.feature_config_id;
}

void forget_file(const std::filesystem::path& file) {
  std::error_code ignored;  // a file left behind is cleared at the next start
  std::filesystem::remove(file, ignored);
}

}  // namespace

std::filesystem::path SqliteStore::map_file(const MapId& map, std::int64_t revision) const {
  return folder_ / "maps" / (map.str() + ".r" + std::to_string(revision) + ".homeward");
}

Result<MapRecord> SqliteStore::add_map(MapRecord map) {
  return database_.work([&](SQLite::Database& database) {
    if (map.id.empty()) map.id = MapId(random_id());
    map.revision = 0;
    return insert_map(database, map);
  });
}

Result<std::vector<MapRecord>> SqliteStore::maps() {
  return database_.work([&](SQLite::Database& database) {
    std::vector<MapRecord> found;
    SQLite::Statement row = prepared(database, kMaps);
    while (row.executeStep()) found.push_back(map_of(database, row));
    return found;
  });
}

Result<MapRecord> SqliteStore::map(const MapId& id) {
  return database_.work([&](SQLite::Database& database) { return need_map(database, id); });
}

Status SqliteStore::set_map_state(const MapId& id, wire::MapState state) {
  return database_.work([&](SQLite::Database& database) {
    need_map(database, id);
    execute(database, "UPDATE maps SET state = ? WHERE id = ?", std::string(wire::map_state_name(state)), id);
  });
}

Status SqliteStore::set_map_refine(const MapId& id, wire::RefineMode mode) {
  return database_.work([&](SQLite::Database& database) {
    need_map(database, id);
    execute(database, "UPDATE maps SET refine = ? WHERE id = ?", std::string(wire::refine_mode_name(mode)), id);
  });
}

Result<MapRecord> SqliteStore::save_map_contents(const MapId& id, const map::TopologicalMap& contents,
                                                 const Thumbnails& thumbnails, std::int64_t expected_revision,
                                                 const AlongWithContents& along) {
  const std::scoped_lock files(map_files_mutex_);
  const std::string where = "maps/" + id.str();
  const Result<MapRecord> before = map(id);
  if (!before) return before;
  if (before->revision != expected_revision) {
    return fail(ErrorCode::kStaleRevision,
                "The map is at revision " + std::to_string(before->revision) + ", not " +
                    std::to_string(expected_revision) + ".",
                where);
  }
  if (contents.revision <= before->revision) {
    return fail(ErrorCode::kInvalidInput, "The revision of a map rises with each change.", where);
  }
  const std::filesystem::path file = map_file(id, contents.revision);
  if (const Status written = save_map(file, contents, thumbnails); !written) return pass_on(written);
  MapRecord after = *before;
  describe(after, contents);
  after.tours.insert(after.tours.end(), along.new_tours.begin(), along.new_tours.end());
  const Status switched = database_.work([&](SQLite::Database& database) {
    if (execute(database,
                "UPDATE maps SET state = 'ready', revision = ?, places = ?, images = ?, feature_config_id = ? "
                "WHERE id = ?",
                after.revision, after.places, after.images, after.feature_config_id, id) == 0) {
      refuse(ErrorCode::kNotFound, "The map has been removed.", where);
    }
    insert_tours(database, id, along.new_tours, before->tours.size());
    forget_drives(database, along.used_drives);
    if (along.job) write_job(database, *along.job);
  });
  if (!switched) {
    forget_file(file);
    return pass_on(switched);
  }
  if (before->revision > 0) forget_file(map_file(id, before->revision));
  return after;
}

Result<StoredMap> SqliteStore::load_map_contents(const MapId& id) {
  const std::scoped_lock files(map_files_mutex_);
  const Result<MapRecord> record = map(id);
  if (!record) return pass_on(record);
  if (record->revision == 0) {
    return fail(ErrorCode::kNotFound, "The map has not been built yet.", "maps/" + id.str());
  }
  return load_map(map_file(id, record->revision));
}

Result<std::vector<std::uint8_t>> SqliteStore::map_file_bytes(const MapId& id) {
  const std::scoped_lock files(map_files_mutex_);
  const Result<MapRecord> record = map(id);
  if (!record) return pass_on(record);
  const std::string where = "maps/" + id.str();
  if (record->revision == 0) return fail(ErrorCode::kNotFound, "The map has not been built yet.", where);
  try {
    return read_whole(map_file(id, record->revision));
  } catch (...) {
    return tl::unexpected<Error>(StoreDatabase::present_error(where));
  }
}

Result<MapRecord> SqliteStore::import_map(MapRecord map, std::span<const std::uint8_t> bytes) {
  const std::scoped_lock files(map_files_mutex_);
  if (map.id.empty()) map.id = MapId(random_id());
  const std::filesystem::path arrived = folder_ / "maps" / (map.id.str() + ".arrived");
  try {
    write_durably(arrived, bytes);
    Result<StoredMap> stored = load_map(arrived);
    if (stored && stored->map.revision < 1) {
      stored = fail(ErrorCode::kCorruptFile, "The map file has no revision.");
    }
    if (!stored) {
      forget_file(arrived);
      return fail(stored.error().code, stored.error().message, "body");
    }
    describe(map, stored->map);
    if (map.name.empty()) map.name = stored->map.name;
    const std::filesystem::path file = map_file(map.id, map.revision);
    std::filesystem::rename(arrived, file);
    make_folder_durably(folder_ / "maps");
    Result<MapRecord> added = database_.work([&](SQLite::Database& database) { return insert_map(database, map); });
    if (!added) forget_file(file);
    return added;
  } catch (...) {
    const Error error = StoreDatabase::present_error(arrived.string());
    forget_file(arrived);
    return tl::unexpected<Error>(error);
  }
}

Status SqliteStore::remove_map(const MapId& id) {
  const std::scoped_lock files(map_files_mutex_);
  const Result<MapRecord> record = map(id);
  if (!record) return pass_on(record);
  const Status removed =
      database_.work([&](SQLite::Database& database) { execute(database, "DELETE FROM maps WHERE id = ?", id); });
  if (removed && record->revision > 0) forget_file(map_file(id, record->revision));
  return removed;
}

void SqliteStore::remove_stray_map_files() {
  const Result<std::vector<MapRecord>> known = maps();
  if (!known) throw StoreFailure(known.error());
  std::set<std::filesystem::path> wanted;
  for (const MapRecord& map : *known) wanted.insert(map_file(map.id, map.revision));
  std::vector<std::filesystem::path> strays;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "maps")) {
    if (!wanted.contains(entry.path())) strays.push_back(entry.path());
  }
  for (const std::filesystem::path& stray : strays) forget_file(stray);
}

}  // namespace homeward::db
