// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/ids.hpp"
#include "core/result.hpp"
#include "db/sqlite/statements.hpp"
#include "db/sqlite/table_sums.hpp"

namespace homeward::db {

/// The lock on a data folder: held as long as the object lives, gone with the process however it ends.
class FolderLock {
 public:
  /// Throws StoreFailure (kConflict, kIo).
  explicit FolderLock(const std::filesystem::path& folder);
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock();

 private:
  int descriptor_ = -1;
};

/// The connections, the lock around the one that writes, and the translation of exceptions.
class StoreDatabase {
 public:
  /// Opens or makes the file, applies the migrations that it lacks, and reads all of it to see that it is what was
  /// written. Throws.
  explicit StoreDatabase(const std::filesystem::path& file);

  /// Runs `body` in one transaction, alone; an exception becomes an Error and undoes everything.
  template <class Body>
  auto work(Body&& body) -> Result<std::invoke_result_t<Body, SQLite::Database&>> {
    const std::scoped_lock lock(mutex_);
    try {
      SQLite::Transaction transaction(connection_, SQLite::TransactionBehavior::IMMEDIATE);
      sums_.begin();
      if constexpr (std::is_void_v<std::invoke_result_t<Body, SQLite::Database&>>) {
        body(connection_);
        sums_.keep();
        transaction.commit();
        return {};
      } else {
        auto value = body(connection_);
        sums_.keep();
        transaction.commit();
        return value;
      }
    } catch (...) {
      return tl::unexpected<Error>(present_error(file_.string()));
    }
  }

  /// Runs `body`, which changes nothing, on a connection of its own: it waits for no writer, and sees what was
  /// committed when it began, from its beginning to its end.
  template <class Body>
  auto read(Body&& body) -> Result<std::invoke_result_t<Body, SQLite::Database&>> {
    try {
      const Reader reader(*this);
      SQLite::Transaction transaction(reader.connection(), SQLite::TransactionBehavior::DEFERRED);
      if constexpr (std::is_void_v<std::invoke_result_t<Body, SQLite::Database&>>) {
        body(reader.connection());
        return {};
      } else {
        return body(reader.connection());
      }
    } catch (...) {
      return tl::unexpected<Error>(present_error(file_.string()));
    }
  }

  /// The exception that is being handled, as an error. `where` is used when it has no place of its own.
  static Error present_error(const std::string& where);

 private:
  /// A connection to read with, while it lives: one that nobody uses, or a new one. There are as many as ever read at
  /// once.
  class Reader {
   public:
    explicit Reader(StoreDatabase& database);
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
    ~Reader();
    [[nodiscard]] SQLite::Database& connection() const { return *connection_; }

   private:
    StoreDatabase& database_;
    std::unique_ptr<SQLite::Database> connection_;
  };

  std::filesystem::path file_;
  std::mutex mutex_;  // of the connection that writes
  SQLite::Database connection_;
  TableSums sums_;
  std::mutex readers_mutex_;
  std::vector<std::unique_ptr<SQLite::Database>> readers_;  // that nobody uses
};

}  // namespace homeward::db
