// SPDX-License-Identifier: Apache-2.0
#include "db/sqlite/store_database.hpp"

#include <fcntl.h>
#include <sqlite3.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "db/sqlite/durable_file.hpp"
#include "db/sqlite/failure_words.hpp"
#include "db/sqlite/migrations.hpp"

namespace homeward::db {
namespace {

constexpr int kStoreApplicationId = 0x48575354;  // "HWST"
constexpr int kBusyTimeoutMs = 5000;
constexpr int kFirstVersionWithSums = 7;

/// Before anything is written to the file: is it one of ours, and not from the future?
int checked_version(SQLite::Database& connection, const std::string& file) {
  const int version = connection.execAndGet("PRAGMA user_version").getInt();
  const int application_id = connection.execAndGet("PRAGMA application_id").getInt();
  const int tables = connection.execAndGet("SELECT count(*) FROM sqlite_schema").getInt();
  if (application_id != kStoreApplicationId && (tables != 0 || version != 0)) {
    refuse(ErrorCode::kCorruptFile, "This SQLite file is not the database of a Homeward server.", file);
  }
  const int newest = static_cast<int>(migrations().size());
  if (version > newest) {
    refuse(ErrorCode::kUnsupportedFormat,
           "The database has version " + std::to_string(version) + "; this program knows versions up to " +
               std::to_string(newest) + ". Start the newer program again, or restore a backup.",
           file);
  }
  const std::string verdict = connection.execAndGet("PRAGMA integrity_check(1)").getString();
  if (verdict != "ok") {
    refuse(ErrorCode::kCorruptFile, "The database is damaged (" + verdict + "). Restore a backup.", file);
  }
  return version;
}

/// All of them or none; the sums of the new content belong to it.
void migrate(SQLite::Database& connection, int version, TableSums& sums) {
  const auto known = static_cast<std::size_t>(version);
  if (known == migrations().size()) return;
  SQLite::Transaction transaction(connection, SQLite::TransactionBehavior::IMMEDIATE);
  for (std::size_t step = known; step < migrations().size(); ++step) connection.exec(std::string(migrations()[step]));
  connection.exec("PRAGMA application_id = " + std::to_string(kStoreApplicationId));
  connection.exec("PRAGMA user_version = " + std::to_string(migrations().size()));
  sums.take_anew();
  transaction.commit();
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "homeward.lock";
  descriptor_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (descriptor_ < 0) {
    refuse(ErrorCode::kIo, "The lock file cannot be opened: " + std::generic_category().message(errno) + ".",
           file.string());
  }
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    const int reason = errno;
    ::close(descriptor_);
    if (reason == EWOULDBLOCK) {
      refuse(ErrorCode::kConflict, "Another Homeward server is running on this data folder.", folder.string());
    }
    refuse(ErrorCode::kIo, "The data folder cannot be locked: " + std::generic_category().message(reason) + ".",
           file.string());
  }
}

FolderLock::~FolderLock() { ::close(descriptor_); }

StoreDatabase::StoreDatabase(const std::filesystem::path& file)
    : file_(file),
      connection_(file.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE, kBusyTimeoutMs),
      sums_(connection_) {
  const int version = checked_version(connection_, file.string());
  connection_.exec("PRAGMA journal_mode = WAL");
  connection_.exec("PRAGMA synchronous = FULL");
  connection_.exec("PRAGMA foreign_keys = ON");
  connection_.exec("PRAGMA trusted_schema = OFF");
  if (version >= kFirstVersionWithSums) sums_.check();
  migrate(connection_, version, sums_);
  sums_.watch();
}

StoreDatabase::Reader::Reader(StoreDatabase& database) : database_(database) {
  {
    const std::scoped_lock lock(database_.readers_mutex_);
    if (!database_.readers_.empty()) {
      connection_ = std::move(database_.readers_.back());
      database_.readers_.pop_back();
    }
  }
  if (connection_) return;
  connection_ = std::make_unique<SQLite::Database>(database_.file_.string(), SQLite::OPEN_READONLY, kBusyTimeoutMs);
  connection_->exec("PRAGMA trusted_schema = OFF");
}

StoreDatabase::Reader::~Reader() {
  const std::scoped_lock lock(database_.readers_mutex_);
  database_.readers_.push_back(std::move(connection_));
}

Error StoreDatabase::present_error(const std::string& where) {
  try {
    throw;
  } catch (const StoreFailure& failure) {
    return failure.error;
  } catch (const SQLite::Exception& failure) {
    const int code = failure.getErrorCode();
    if (code == SQLITE_CORRUPT || code == SQLITE_NOTADB) {
      return {ErrorCode::kCorruptFile, "The database is damaged (" + words_of(failure) + "). Restore a backup.", where};
    }
    if (code == SQLITE_FULL) return disk_full(where);
    return {ErrorCode::kIo, "The database does not work: " + words_of(failure) + ".", where};
  } catch (const std::system_error& failure) {
    if (is_disk_full(failure.code())) return disk_full(where);
    return {ErrorCode::kIo, "The data folder does not work: " + words_of(failure) + ".", where};
  } catch (const std::exception& failure) {
    return {ErrorCode::kIo, "The data folder does not work: " + words_of(failure) + ".", where};
  }
}

}  // namespace homeward::db
