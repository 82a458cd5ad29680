// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "core/ids.hpp"
#include "core/result.hpp"

namespace homeward::db {

/// Carries an Error out of a store function to StoreDatabase::work, which undoes what was begun.
struct StoreFailure : std::runtime_error {
  explicit StoreFailure(Error failure) : std::runtime_error(failure.message), error(std::move(failure)) {}
  Error error;
};

[[noreturn]] inline void refuse(ErrorCode code, std::string message, std::string where = {}) {
  throw StoreFailure({code, std::move(message), std::move(where)});
}

inline void bind_value(SQLite::Statement& statement, int index, const std::string& value) {
  statement.bind(index, value);
}
inline void bind_value(SQLite::Statement& statement, int index, double value) { statement.bind(index, value); }
template <class Integer>
requires std::is_integral_v<Integer>
void bind_value(SQLite::Statement& statement, int index, Integer value) {
  statement.bind(index, static_cast<std::int64_t>(value));
}
template <class Tag>
void bind_value(SQLite::Statement& statement, int index, const Id<Tag>& value) {
  statement.bind(index, value.str());
}
template <class T>
void bind_value(SQLite::Statement& statement, int index, const std::optional<T>& value) {
  if (value) {
    bind_value(statement, index, *value);
  } else {
    statement.bind(index);
  }
}

/// A prepared statement with its values bound in order.
template <class... Values>
SQLite::Statement prepared(SQLite::Database& database, const char* sql, const Values&... values) {
  SQLite::Statement statement(database, sql);
  [[maybe_unused]] int index = 0;
  (bind_value(statement, ++index, values), ...);
  return statement;
}

/// Runs a statement without rows and gives the number of rows that it changed.
template <class... Values>
int execute(SQLite::Database& database, const char* sql, const Values&... values) {
  return prepared(database, sql, values...).exec();
}

inline std::string text(SQLite::Statement& row, int column) { return row.getColumn(column).getString(); }
inline std::int64_t integer(SQLite::Statement& row, int column) { return row.getColumn(column).getInt64(); }
inline double real(SQLite::Statement& row, int column) { return row.getColumn(column).getDouble(); }
inline std::optional<std::string> optional_text(SQLite::Statement& row, int column) {
  return row.isColumnNull(column) ? std::nullopt : std::optional(text(row, column));
}
inline std::optional<std::int64_t> optional_integer(SQLite::Statement& row, int column) {
  return row.isColumnNull(column) ? std::nullopt : std::optional(integer(row, column));
}

inline std::optional<double> optional_number(SQLite::Statement& row, int column) {
  return row.isColumnNull(column) ? std::nullopt : std::optional(real(row, column));
}

}  // namespace homeward::db
