// SPDX-License-Identifier: Apache-2.0
#include "db/secrets.hpp"
#include "db/sqlite/durable_file.hpp"
#include "db/sqlite/failure_words.hpp"
#include "db/sqlite/map_graph_part.hpp"
#include "db/sqlite/sqlite_store.hpp"

namespace homeward::db {
namespace {

constexpr const char* kMaps =
    "SELECT id, name, state, revision, places, images, feature_config_id, created_us, refine, path, plan, version, "
    "tied_us "
    "FROM maps LEFT JOIN map_plans ON map = id ORDER BY created_us, maps.rowid";
constexpr const char* kOneMap =
    "SELECT id, name, state, revision, places, images, feature_config_id, created_us, refine, path, plan, version, "
    "tied_us "
    "FROM maps LEFT JOIN map_plans ON map = id WHERE id = ?";

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
  map.path = integer(row, 9) != 0;
  if (const auto plan = optional_text(row, 10)) {
    map.plan = wire::MapPlanInfo{wire::PlanId(*plan), integer(row, 11), integer(row, 12)};
  }
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
          "INSERT INTO maps (id, name, state, revision, places, images, feature_config_id, created_us, refine, "
          "file_revision, path) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
          map.id, map.name, std::string(wire::map_state_name(map.state)), map.revision, map.places, map.images,
          map.feature_config_id, map.created_us, std::string(wire::refine_mode_name(map.refine)), map.revision,
          std::int64_t{map.path ? 1 : 0});
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

/// Whether new contents may follow the ones that there are.
Status check_revision(const MapRecord& before, const map::TopologicalMap& contents, std::int64_t expected_revision) {
  const std::string where = "maps/" + before.id.str();
  if (before.revision != expected_revision) {
    return fail(ErrorCode::kStaleRevision,
                "The map is at revision " + std::to_string(before.revision) + ", not " +
                    std::to_string(expected_revision) + ".",
                where);
  }
  if (contents.revision > before.revision) return {};
  return fail(ErrorCode::kInvalidInput, "The revision of a map rises with each change.", where);
}

void update_map(SQLite::Database& database, const MapRecord& map, std::int64_t file_revision) {
  if (execute(database,
              "UPDATE maps SET state = 'ready', revision = ?, places = ?, images = ?, feature_config_id = ?, "
              "file_revision = ? WHERE id = ?",
              map.revision, map.places, map.images, map.feature_config_id, file_revision, map.id) == 0) {
    refuse(ErrorCode::kNotFound, "The map has been removed.", "maps/" + map.id.str());
  }
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
  return database_.read([&](SQLite::Database& database) {
    std::vector<MapRecord> found;
    SQLite::Statement row = prepared(database, kMaps);
    while (row.executeStep()) found.push_back(map_of(database, row));
    return found;
  });
}

Result<MapRecord> SqliteStore::map(const MapId& id) {
  return database_.read([&](SQLite::Database& database) { return need_map(database, id); });
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
    if (mode == wire::RefineMode::kOff) execute(database, "DELETE FROM drives WHERE map = ?", id);
  });
}

Result<SqliteStore::MapFile> SqliteStore::file_of(const MapId& id) {
  return database_.read([&](SQLite::Database& database) {
    MapFile file;
    file.record = need_map(database, id);
    SQLite::Statement row =
        prepared(database, "SELECT file_revision, contents FROM maps LEFT JOIN map_edits ON map = id WHERE id = ?", id);
    row.executeStep();
    file.revision = integer(row, 0);
    const SQLite::Column edits = row.getColumn(1);
    const auto* const bytes = static_cast<const std::uint8_t*>(edits.getBlob());
    file.edits.assign(bytes, bytes + edits.getBytes());
    return file;
  });
}

Result<StoredMap> SqliteStore::load(const MapFile& file) const {
  const std::string where = "maps/" + file.record.id.str();
  if (file.record.revision == 0) return fail(ErrorCode::kNotFound, "The map has not been built yet.", where);
  Result<StoredMap> stored = load_map(map_file(file.record.id, file.revision));
  if (!stored || file.edits.empty()) return stored;
  try {
    put_graph_part(file.edits, stored->map);
    return stored;
  } catch (const std::exception& failure) {
    return fail(ErrorCode::kCorruptFile, "The edits of the map cannot be put over its file: " + words_of(failure),
                where);
  }
}

Result<MapRecord> SqliteStore::save_map_contents(const MapId& id, const map::TopologicalMap& contents,
                                                 const Thumbnails& thumbnails, std::int64_t expected_revision,
                                                 const AlongWithContents& along) {
  const KeyedMutex::Hold alone(map_file_locks_, id.str());
  const Result<MapFile> before = file_of(id);
  if (!before) return pass_on(before);
  if (const Status fits = check_revision(before->record, contents, expected_revision); !fits) return pass_on(fits);
  const std::filesystem::path file = map_file(id, contents.revision);
  if (const Status written = save_map(file, contents, thumbnails); !written) return pass_on(written);
  MapRecord after = before->record;
  describe(after, contents);
  after.tours.insert(after.tours.end(), along.new_tours.begin(), along.new_tours.end());
  const Status switched = database_.work([&](SQLite::Database& database) {
    update_map(database, after, after.revision);
    execute(database, "DELETE FROM map_edits WHERE map = ?", id);
    insert_tours(database, id, along.new_tours, before->record.tours.size());
    mark_drives_used(database, along.used_drives);
    if (along.job) write_job(database, *along.job);
    if (along.build) write_build(database, id, contents.revision, *along.build);
    if (along.draft) execute(database, "DELETE FROM drafts WHERE id = ?", *along.draft);
  });
  if (!switched) {
    forget_file_after(switched.error(), file);
    return pass_on(switched);
  }
  if (before->revision > 0) {
    forget_file(map_file(id, before->revision));
    need_no_longer(map_file(id, before->revision));
  }
  return after;
}

Result<MapRecord> SqliteStore::save_map_edit(const MapId& id, const map::TopologicalMap& edited,
                                             std::int64_t expected_revision) {
  const KeyedMutex::Hold alone(map_file_locks_, id.str());
  const Result<MapFile> before = file_of(id);
  if (!before) return pass_on(before);
  if (const Status fits = check_revision(before->record, edited, expected_revision); !fits) return pass_on(fits);
  const std::vector<std::uint8_t> part = graph_part_of(edited);
  MapRecord after = before->record;
  describe(after, edited);
  const Status switched = database_.work([&](SQLite::Database& database) {
    update_map(database, after, before->revision);
    SQLite::Statement insert = prepared(database, "INSERT OR REPLACE INTO map_edits (map, contents) VALUES (?, ?)", id);
    insert.bind(2, part.data(), static_cast<int>(part.size()));
    insert.exec();
  });
  if (!switched) return pass_on(switched);
  return after;
}

Result<StoredMap> SqliteStore::load_map_contents(const MapId& id) {
  const KeyedMutex::Hold alone(map_file_locks_, id.str());
  const Result<MapFile> file = file_of(id);
  if (!file) return pass_on(file);
  return load(*file);
}

/// With the map's lock.
Status SqliteStore::write_edits_into_file(const MapId& id, const MapFile& file) {
  const Result<StoredMap> stored = load(file);
  if (!stored) return pass_on(stored);
  const Status written = save_map(map_file(id, file.record.revision), stored->map, stored->thumbnails);
  if (!written) return written;
  const Status switched = database_.work([&](SQLite::Database& database) {
    update_map(database, file.record, file.record.revision);
    execute(database, "DELETE FROM map_edits WHERE map = ?", id);
  });
  if (switched) {
    forget_file(map_file(id, file.revision));
  } else {
    forget_file_after(switched.error(), map_file(id, file.record.revision));
  }
  return switched;
}

Result<std::vector<std::uint8_t>> SqliteStore::map_file_bytes(const MapId& id) {
  const KeyedMutex::Hold alone(map_file_locks_, id.str());
  const Result<MapFile> file = file_of(id);
  if (!file) return pass_on(file);
  const std::string where = "maps/" + id.str();
  if (file->record.revision == 0) return fail(ErrorCode::kNotFound, "The map has not been built yet.", where);
  if (!file->edits.empty()) {
    if (const Status written = write_edits_into_file(id, *file); !written) return pass_on(written);
  }
  try {
    return read_whole(map_file(id, file->record.revision));
  } catch (...) {
    return tl::unexpected<Error>(StoreDatabase::present_error(where));
  }
}

Result<MapRecord> SqliteStore::import_map(MapRecord map, std::string bytes) {
  if (map.id.empty()) map.id = MapId(random_id());
  const KeyedMutex::Hold alone(map_file_locks_, map.id.str());
  const std::filesystem::path arrived = folder_ / "maps" / (map.id.str() + ".arrived");
  try {
    write_durably(arrived, {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    std::string().swap(bytes);
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
    flush_folder(folder_ / "maps");
    Result<MapRecord> added = database_.work([&](SQLite::Database& database) { return insert_map(database, map); });
    if (!added) forget_file_after(added.error(), file);
    return added;
  } catch (...) {
    const Error error = StoreDatabase::present_error(arrived.string());
    forget_file(arrived);
    return tl::unexpected<Error>(error);
  }
}

Status SqliteStore::remove_map(const MapId& id) {
  const KeyedMutex::Hold alone(map_file_locks_, id.str());
  const Result<MapFile> kept = file_of(id);
  if (!kept) return pass_on(kept);
  const std::filesystem::path file = map_file(id, kept->revision);
  std::error_code none;  // where there is no file
  std::filesystem::rename(file, removed_name(file), none);
  const Status removed = database_.work([&](SQLite::Database& database) {
    flush_folder(folder_ / "maps");
    execute(database, "DELETE FROM maps WHERE id = ?", id);
  });
  if (!removed) {
    std::filesystem::rename(removed_name(file), file, none);
    return removed;
  }
  forget_file(removed_name(file));
  need_no_longer(file);
  return {};
}

}  // namespace homeward::db
