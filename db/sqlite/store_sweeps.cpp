// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "db/sqlite/sqlite_store.hpp"
#include "wire/scans_json.hpp"

namespace homeward::db {
namespace {

using nlohmann::json;

using Blob = std::vector<std::uint8_t>;

Blob blob_in(SQLite::Statement& row, int column) {
  const SQLite::Column blob = row.getColumn(column);
  const auto* bytes = static_cast<const std::uint8_t*>(blob.getBlob());
  return {bytes, bytes + blob.getBytes()};
}

/// Null for what is no CBOR, which no reader of sweeps takes.
json json_of(const Blob& bytes) {
  json value = json::from_cbor(bytes, true, false);
  return value.is_discarded() ? json() : value;
}

std::string name_of(const TourId& tour, std::int64_t number) {
  return "tours/" + tour.str() + "/images/" + std::to_string(number);
}

}  // namespace

Result<PutImage> SqliteStore::put_sweep(const TourId& tour, const TourSweep& sweep) {
  const json value = wire::sweep_to_json(sweep.sweep);
  const Blob bytes = json::to_cbor(value);
  return database_.work([&](SQLite::Database& database) {
    const std::string where = name_of(tour, sweep.number);
    SQLite::Statement found =
        prepared(database,
                 "SELECT t.complete, i.file, s.sweep FROM tours t LEFT JOIN tour_images i ON i.tour = t.id AND "
                 "i.number = ? LEFT JOIN tour_sweeps s ON s.tour = i.tour AND s.number = i.number WHERE t.id = ?",
                 sweep.number, tour);
    if (!found.executeStep()) {
      refuse(ErrorCode::kNotFound, "There is no tour with this id.", "tours/" + tour.str());
    }
    if (found.isColumnNull(1)) refuse(ErrorCode::kNotFound, "There is no such image.", where);
    if (!sweep.file.empty() && sweep.file != text(found, 1)) {
      refuse(ErrorCode::kConflict, "This image of the tour is called '" + text(found, 1) + "'.", where);
    }
    if (!found.isColumnNull(2)) return json_of(blob_in(found, 2)) == value ? PutImage::kSame : PutImage::kConflict;
    if (integer(found, 0) != 0) {
      refuse(ErrorCode::kConflict, "The tour is complete; it takes no more sweeps.", where);
    }
    SQLite::Statement insert =
        prepared(database, "INSERT INTO tour_sweeps (tour, number, sweep) VALUES (?, ?, ?)", tour, sweep.number);
    insert.bind(3, bytes.data(), static_cast<int>(bytes.size()));
    insert.exec();
    return PutImage::kNew;
  });
}

Result<std::map<std::int64_t, RangeSweep>> SqliteStore::sweeps(const TourId& tour) {
  const auto kept = database_.read([&](SQLite::Database& database) {
    SQLite::Statement known = prepared(database, "SELECT 1 FROM tours WHERE id = ?", tour);
    if (!known.executeStep()) {
      refuse(ErrorCode::kNotFound, "There is no tour with this id.", "tours/" + tour.str());
    }
    std::map<std::int64_t, Blob> blobs;
    SQLite::Statement row = prepared(database, "SELECT number, sweep FROM tour_sweeps WHERE tour = ?", tour);
    while (row.executeStep()) blobs.emplace(integer(row, 0), blob_in(row, 1));
    return blobs;
  });
  if (!kept) return pass_on(kept);
  // Read outside of the store's lock: a long tour has millions of ranges.
  std::map<std::int64_t, RangeSweep> sweeps;
  for (const auto& [number, bytes] : *kept) {
    const std::string where = name_of(tour, number) + "/sweep";
    auto sweep = wire::sweep_from_json(json_of(bytes), where);
    if (!sweep) {
      return fail(ErrorCode::kCorruptFile, "The kept sweep cannot be read: " + sweep.error().message, where);
    }
    sweeps.emplace(number, std::move(*sweep));
  }
  return sweeps;
}

}  // namespace homeward::db
