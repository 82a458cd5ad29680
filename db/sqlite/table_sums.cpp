// SPDX-License-Identifier: Apache-2.0
#include "db/sqlite/table_sums.hpp"

#include <sodium.h>
#include <sqlite3.h>

#include <array>
#include <cmath>
#include <cstring>
#include <utility>
#include <vector>

#include "db/sqlite/statements.hpp"

namespace homeward::db {
namespace {

using Sum = TableSums::Sum;

constexpr const char* kSchema = "sqlite_schema";
constexpr const char* kOwnTable = "table_sums";
constexpr double kWholeNumbersUpTo = 9007199254740992.0;  // 2^53

class RowHash {
 public:
  RowHash() { crypto_generichash_init(&state_, nullptr, 0, kBytes); }

  void add(sqlite3_value* value) {
    switch (sqlite3_value_type(value)) {
      case SQLITE_INTEGER:
        return add_integer(sqlite3_value_int64(value));
      case SQLITE_FLOAT: {
        // A whole number in a column of reals is kept as an integer, and may come as either.
        const double number = sqlite3_value_double(value);
        if (std::abs(number) <= kWholeNumbersUpTo && number == std::floor(number)) {
          return add_integer(static_cast<std::int64_t>(number));
        }
        return add_bytes('f', &number, sizeof number);
      }
      case SQLITE_TEXT: {
        const unsigned char* const bytes = sqlite3_value_text(value);
        return add_bytes('t', bytes, sqlite3_value_bytes(value));
      }
      case SQLITE_BLOB: {
        const void* const bytes = sqlite3_value_blob(value);
        return add_bytes('b', bytes, sqlite3_value_bytes(value));
      }
      default:
        return add_bytes('0', nullptr, 0);
    }
  }

  Sum sum() {
    std::array<unsigned char, kBytes> hash{};
    crypto_generichash_final(&state_, hash.data(), hash.size());
    Sum sum{1, 0, 0};
    std::memcpy(&sum.low, hash.data(), sizeof sum.low);
    std::memcpy(&sum.high, hash.data() + sizeof sum.low, sizeof sum.high);
    return sum;
  }

 private:
  static constexpr std::size_t kBytes = 16;

  void add_integer(std::int64_t number) { add_bytes('i', &number, sizeof number); }
  void add_bytes(char type, const void* bytes, int count) {
    std::array<unsigned char, 1 + sizeof count> head{static_cast<unsigned char>(type)};
    std::memcpy(head.data() + 1, &count, sizeof count);
    crypto_generichash_update(&state_, head.data(), head.size());
    if (count > 0) crypto_generichash_update(&state_, static_cast<const unsigned char*>(bytes), std::size_t(count));
  }

  crypto_generichash_state state_{};
};

// SQL: note_row(table, sign, column...)
void note_row(sqlite3_context* context, int count, sqlite3_value** values) {
  auto* const sums = static_cast<TableSums*>(sqlite3_user_data(context));
  const std::string table(reinterpret_cast<const char*>(sqlite3_value_text(values[0])));
  sums->note(table, sqlite3_value_int(values[1]), count - 2, values + 2);
}

std::string quoted(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + "\"";
}

std::vector<std::string> texts(SQLite::Database& connection, const std::string& sql) {
  SQLite::Statement row(connection, sql);
  std::vector<std::string> found;
  while (row.executeStep()) found.push_back(text(row, 0));
  return found;
}

std::vector<std::string> watched_tables(SQLite::Database& connection) {
  return texts(connection,
               "SELECT name FROM sqlite_schema WHERE type = 'table' AND name NOT LIKE 'sqlite\\_%' ESCAPE '\\' AND "
               "name <> 'table_sums' ORDER BY name");
}

std::vector<std::string> columns_of(SQLite::Database& connection, const std::string& table) {
  return texts(connection, "SELECT name FROM pragma_table_info(" + quoted(table) + ") ORDER BY cid");
}

std::string listed(const std::vector<std::string>& columns, const std::string& prefix) {
  std::string list;
  for (const std::string& column : columns) list += ", " + prefix + quoted(column);
  return list;
}

}  // namespace

void Sum::add(const Sum& other) {
  rows += other.rows;
  low += other.low;
  high += other.high;
}

TableSums::TableSums(SQLite::Database& connection) : connection_(connection) {
  if (sodium_init() < 0) refuse(ErrorCode::kInternal, "The cryptographic library does not work.");
  constexpr int kFlags = SQLITE_UTF8 | SQLITE_INNOCUOUS;
  if (sqlite3_create_function_v2(connection_.getHandle(), "note_row", -1, kFlags, this, note_row, nullptr, nullptr,
                                 nullptr) != SQLITE_OK) {
    throw SQLite::Exception(connection_.getHandle());
  }
}

void TableSums::watch() {
  // What REPLACE takes away counts as well.
  connection_.exec("PRAGMA recursive_triggers = ON");
  for (const std::string& table : watched_tables(connection_)) {
    const std::vector<std::string> columns = columns_of(connection_, table);
    const std::string plus = " SELECT note_row('" + table + "', 1" + listed(columns, "NEW.") + ");";
    const std::string minus = " SELECT note_row('" + table + "', -1" + listed(columns, "OLD.") + ");";
    const auto trigger = [&](const std::string& event, const std::string& calls) {
      connection_.exec("CREATE TEMP TRIGGER sums_" + event + "_" + table + " AFTER " + event + " ON main." +
                       quoted(table) + " BEGIN" + calls + " END");
    };
    trigger("INSERT", plus);
    trigger("DELETE", minus);
    trigger("UPDATE", minus + plus);
  }
}

void TableSums::note(const std::string& table, int sign, int count, sqlite3_value** values) {
  RowHash hash;
  for (int i = 0; i < count; ++i) hash.add(values[i]);
  Sum sum = hash.sum();
  if (sign < 0) sum = {-1, ~sum.low + 1, ~sum.high + 1};
  changes_[table].add(sum);
}

Sum TableSums::sum_of(const std::string& table) {
  // Pages may move, so where a table begins does not count.
  const std::string columns =
      table == kSchema ? ", type, name, tbl_name, sql" : listed(columns_of(connection_, table), "");
  const std::map<std::string, Sum> before = std::exchange(changes_, {});
  SQLite::Statement row(connection_, "SELECT note_row('" + table + "', 1" + columns + ") FROM main." + quoted(table));
  while (row.executeStep()) {
  }
  return std::exchange(changes_, before)[table];
}

std::map<std::string, Sum> TableSums::kept() {
  std::map<std::string, Sum> sums;
  SQLite::Statement row(connection_, "SELECT name, row_count, sum FROM table_sums");
  while (row.executeStep()) {
    Sum sum{integer(row, 1), 0, 0};
    const SQLite::Column halves = row.getColumn(2);
    if (halves.getBytes() != sizeof sum.low + sizeof sum.high) {
      refuse(ErrorCode::kCorruptFile, "The database is damaged: a checksum is not one. Restore a backup.", kOwnTable);
    }
    const auto* const bytes = static_cast<const unsigned char*>(halves.getBlob());
    std::memcpy(&sum.low, bytes, sizeof sum.low);
    std::memcpy(&sum.high, bytes + sizeof sum.low, sizeof sum.high);
    sums[text(row, 0)] = sum;
  }
  return sums;
}

void TableSums::write(const std::string& table, const Sum& sum) {
  std::array<unsigned char, sizeof sum.low + sizeof sum.high> halves{};
  std::memcpy(halves.data(), &sum.low, sizeof sum.low);
  std::memcpy(halves.data() + sizeof sum.low, &sum.high, sizeof sum.high);
  SQLite::Statement insert(connection_, "INSERT OR REPLACE INTO table_sums (name, row_count, sum) VALUES (?, ?, ?)");
  insert.bind(1, table);
  insert.bind(2, sum.rows);
  insert.bind(3, halves.data(), static_cast<int>(halves.size()));
  insert.exec();
}

void TableSums::keep() {
  if (changes_.empty()) return;
  std::map<std::string, Sum> sums = kept();
  for (const auto& [table, change] : changes_) {
    if (change == Sum()) continue;
    sums[table].add(change);
    write(table, sums[table]);
  }
  changes_.clear();
}

void TableSums::take_anew() {
  connection_.exec("DELETE FROM table_sums");
  for (const std::string& table : watched_tables(connection_)) write(table, sum_of(table));
  write(kSchema, sum_of(kSchema));
}

void TableSums::check() {
  const std::map<std::string, Sum> sums = kept();
  std::vector<std::string> tables = watched_tables(connection_);
  tables.emplace_back(kSchema);
  for (const std::string& table : tables) {
    const auto sum = sums.find(table);
    if (sum == sums.end() || sum->second != sum_of(table)) {
      refuse(ErrorCode::kCorruptFile,
             "The database is damaged: its table '" + table +
                 "' does not have the checksum of what was written. Restore a backup.",
             table);
    }
  }
  if (sums.size() != tables.size()) {
    refuse(ErrorCode::kCorruptFile, "The database is damaged: a table is gone. Restore a backup.", kOwnTable);
  }
}

}  // namespace homeward::db
