// SPDX-License-Identifier: Apache-2.0
#include "db/sqlite/appearance_pool.hpp"

#include <span>
#include <string>
#include <utility>

#include "db/sqlite/map_file_failure.hpp"
#include "wire/appearance_blob.hpp"

namespace homeward::db {

AppearanceWriter::AppearanceWriter(SQLite::Database& database)
    : insert_(database, "INSERT INTO appearances VALUES (?, ?)") {}

std::int64_t AppearanceWriter::number_of(const map::AppearanceList::Shared& appearance) {
  const auto [known, is_new] = numbers_.try_emplace(appearance.get(), static_cast<std::int64_t>(numbers_.size()));
  if (is_new) {
    const std::vector<std::uint8_t> bytes = wire::encode_appearance(*appearance);
    insert_.bind(1, known->second);
    insert_.bind(2, bytes.data(), static_cast<int>(bytes.size()));
    insert_.exec();
    insert_.reset();
  }
  return known->second;
}

AppearanceReader::AppearanceReader(SQLite::Database& database, ContentDigest& digest) {
  DigestedRows select(database, "SELECT appearance FROM appearances ORDER BY number", digest);
  while (select.step()) {
    const std::string where = "appearances/" + std::to_string(appearances_.size());
    appearances_.push_back(std::make_shared<const features::Appearance>(appearance_in(select.column(0), where)));
  }
}

const map::AppearanceList::Shared& AppearanceReader::at(std::int64_t number) const {
  if (number >= 0 && number < static_cast<std::int64_t>(appearances_.size())) {
    return appearances_[static_cast<std::size_t>(number)];
  }
  refuse_file("The map file has no appearance " + std::to_string(number) + ".");
}

features::Appearance appearance_in(const SQLite::Column& column, const std::string& where) {
  const auto* bytes = static_cast<const std::uint8_t*>(column.getBlob());
  const auto size = static_cast<std::size_t>(column.getBytes());
  Result<features::Appearance> appearance = wire::decode_appearance(std::span(bytes, size), where);
  if (!appearance) throw LoadFailure(appearance.error());
  return std::move(*appearance);
}

}  // namespace homeward::db
