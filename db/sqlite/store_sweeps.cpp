// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "db/sqlite/sqlite_store.hpp"
#include "wire/scans_json.hpp"

namespace homeward::db {
namespace {

using nlohmann::json;

std::vector<std::uint8_t> blob_in(SQLite::Statement& row, int column) {
  const SQLite::Column blob = row.getColumn(column);
  const auto* bytes = static_cast<const std::uint8_t*>(blob.getBlob());
  return {bytes, bytes + blob.getBytes()};
}

RangeSweep sweep_in(const std::vector<std::uint8_t>& bytes, const std::string& where) {
  const json value = json::from_cbor(bytes, true, false);
  auto sweep = wire::sweep_from_json(value.is_discarded() ? json() : value, where);
  if (!sweep) refuse(ErrorCode::kCorruptFile, "The kept sweep cannot be read: " + sweep.error().message, where);
  return std::move(*sweep);
}

std::string name_of(const TourId& tour, std::int64_t number) {
  return "tours/" + tour.str() + "/images/" + std::to_string(number);
}

}  // namespace

Result<PutImage> SqliteStore::put_sweep(const TourId& tour, std::int64_t number, const RangeSweep& sweep) {
  const std::vector<std::uint8_t> bytes = json::to_cbor(wire::sweep_to_json(sweep));
  return database_.work([&](SQLite::Database& database) {
    const std::string where = name_of(tour, number);
    SQLite::Statement found =
        prepared(database,
                 "SELECT t.complete, i.number, s.sweep FROM tours t LEFT JOIN tour_images i ON i.tour = t.id AND "
                 "i.number = ? LEFT JOIN tour_sweeps s ON s.tour = i.tour AND s.number = i.number WHERE t.id = ?",
                 number, tour);
    if (!found.executeStep()) {
      refuse(ErrorCode::kNotFound, "There is no tour with this id.", "tours/" + tour.str());
    }
    if (found.isColumnNull(1)) refuse(ErrorCode::kNotFound, "There is no such image.", where);
    if (!found.isColumnNull(2)) return blob_in(found, 2) == bytes ? PutImage::kSame : PutImage::kConflict;
    if (integer(found, 0) != 0) {
      refuse(ErrorCode::kConflict, "The tour is complete; it takes no more sweeps.", where);
    }
    SQLite::Statement insert =
        prepared(database, "INSERT INTO tour_sweeps (tour, number, sweep) VALUES (?, ?, ?)", tour, number);
    insert.bind(3, bytes.data(), static_cast<int>(bytes.size()));
    insert.exec();
    return PutImage::kNew;
  });
}

Result<std::map<std::int64_t, RangeSweep>> SqliteStore::sweeps(const TourId& tour) {
  return database_.work([&](SQLite::Database& database) {
    std::map<std::int64_t, RangeSweep> found;
    SQLite::Statement row = prepared(database, "SELECT number, sweep FROM tour_sweeps WHERE tour = ?", tour);
    while (row.executeStep()) {
      found.emplace(integer(row, 0), sweep_in(blob_in(row, 1), name_of(tour, integer(row, 0)) + "/sweep"));
    }
    return found;
  });
}

}  // namespace homeward::db
