// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <map>
#include <string>

namespace homeward::db {

/// What a database's tables hold, summed up so that a change which nobody made is noticed: of each table the number of
/// its rows and the sum (modulo 2^64, in two halves) of their BLAKE2b-128 hashes. The order of the rows does not count
/// and a change costs the hashes of the changed rows alone. Incremental multiset hash by addition (M. Bellare and
/// D. Micciancio, "A New Paradigm for Collision-Free Hashing", 1997), against flipped bits, not against attackers. The
/// sums stand in the table table_sums.
class TableSums {
 public:
  /// `connection` has to outlive it.
  explicit TableSums(SQLite::Database& connection);
  TableSums(const TableSums&) = delete;
  TableSums& operator=(const TableSums&) = delete;

  /// Notes what this connection changes from now on, through temporary triggers; its schema must not change any more.
  void watch();
  /// With the transaction that begins.
  void begin() { changes_.clear(); }
  /// Adds what has changed since begin() to the sums. Within the transaction, at its end.
  void keep();
  /// Sums up all tables, for a database that has no sums yet. Within a transaction.
  void take_anew();
  /// Throws StoreFailure (kCorruptFile, which names the table) where a table does not have its sum.
  void check();

  struct Sum {
    std::int64_t rows = 0;
    std::uint64_t low = 0;
    std::uint64_t high = 0;
    void add(const Sum& other);
    bool operator==(const Sum&) const = default;
  };
  /// One row's part, counted or, with `sign` -1, taken away.
  void note(const std::string& table, int sign, int count, sqlite3_value** values);

 private:
  Sum sum_of(const std::string& table);
  std::map<std::string, Sum> kept();
  void write(const std::string& table, const Sum& sum);

  SQLite::Database& connection_;
  std::map<std::string, Sum> changes_;
};

}  // namespace homeward::db
