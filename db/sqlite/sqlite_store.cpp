// SPDX-License-Identifier: Apache-2.0
#include "db/sqlite/sqlite_store.hpp"

#include "db/sqlite/durable_file.hpp"
#include "db/sqlite/wal_check.hpp"
#include "wire/reason_json.hpp"

namespace homeward::db {
namespace {

/// After a restart nothing moves until a person says so again.
void stop_missions(SQLite::Database& database) {
  execute(database, "UPDATE missions SET state = 'stopped', reason = ? WHERE state IN ('accepted', 'driving')",
          wire::reason_to_text({wire::ReasonCode::kServerRestarted}));
}

/// For its owner alone: what is kept is of somebody's home.
void make_private_folder(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::filesystem::permissions(folder, std::filesystem::perms::owner_all);
}

const std::filesystem::path& checked(const std::filesystem::path& database) {
  check_write_ahead_log(database);
  return database;
}

}  // namespace

SqliteStore::SqliteStore(const std::filesystem::path& folder)
    : lock_(folder), folder_(folder), database_(checked(folder / "homeward.db")) {
  make_folder_durably(folder_ / "tours");
  make_folder_durably(folder_ / "maps");
  const Status stopped = database_.work(stop_missions);
  // On a full disk a server starts all the same: whoever reads those missions takes them for stopped.
  if (!stopped && stopped.error().code != ErrorCode::kDiskFull) throw StoreFailure(stopped.error());
  sort_map_files();
  sort_pictures();
}

Result<std::unique_ptr<Store>> open_sqlite_store(const std::filesystem::path& data_directory) {
  try {
    const std::filesystem::path folder = std::filesystem::absolute(data_directory);
    make_private_folder(folder);
    return std::make_unique<SqliteStore>(folder);
  } catch (...) {
    return tl::unexpected<Error>(StoreDatabase::present_error((data_directory / "homeward.db").string()));
  }
}

}  // namespace homeward::db
