// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>
#include <sodium.h>

#include <string>

namespace homeward::db {

/// BLAKE2b-256 over the rows that were read, in the order of reading. It stands over what a reader sees and not over
/// the bytes of the file, so that it also notices a damaged index, and does not mind what no reader looks at.
class ContentDigest {
 public:
  ContentDigest();
  /// The row that the statement stands on: types, lengths and values of all its columns.
  void add_row(SQLite::Statement& row);
  /// Tells "no more rows" from rows that are absent.
  void end_rows();
  /// Ends it. To be called once.
  [[nodiscard]] std::string hexadecimal();

 private:
  void add(const void* bytes, std::size_t count);
  crypto_generichash_state state_{};
};

/// Steps through a SELECT's rows and takes each into a digest.
class DigestedRows {
 public:
  DigestedRows(SQLite::Database& database, const char* sql, ContentDigest& digest)
      : statement_(database, sql), digest_(digest) {}
  /// Begins again, for this key.
  void restart(const std::string& key) {
    statement_.reset();
    statement_.bind(1, key);
  }
  bool step() {
    const bool there = statement_.executeStep();
    there ? digest_.add_row(statement_) : digest_.end_rows();
    return there;
  }
  SQLite::Column column(int index) { return statement_.getColumn(index); }

 private:
  SQLite::Statement statement_;
  ContentDigest& digest_;
};

}  // namespace homeward::db
