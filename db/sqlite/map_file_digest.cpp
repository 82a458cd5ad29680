// SPDX-License-Identifier: Apache-2.0
#include "db/sqlite/map_file_digest.hpp"

#include <array>
#include <cstdint>
#include <stdexcept>

namespace homeward::db {

ContentDigest::ContentDigest() {
  if (sodium_init() < 0) throw std::runtime_error("libsodium does not start");
  crypto_generichash_init(&state_, nullptr, 0, crypto_generichash_BYTES);
}

void ContentDigest::add(const void* bytes, std::size_t count) {
  crypto_generichash_update(&state_, static_cast<const unsigned char*>(bytes), count);
}

void ContentDigest::add_row(SQLite::Statement& row) {
  const int columns = row.getColumnCount();
  add(&columns, sizeof(columns));
  for (int i = 0; i < columns; ++i) {
    const SQLite::Column column = row.getColumn(i);
    const int type = column.getType();
    add(&type, sizeof(type));
    if (type == SQLite::INTEGER) {
      const std::int64_t value = column.getInt64();
      add(&value, sizeof(value));
    } else if (type == SQLite::FLOAT) {
      const double value = column.getDouble();
      add(&value, sizeof(value));
    } else if (type != SQLite::Null) {
      const void* bytes = column.getBlob();
      const int count = column.getBytes();
      add(&count, sizeof(count));
      if (count > 0) add(bytes, static_cast<std::size_t>(count));
    }
  }
}

void ContentDigest::end_rows() {
  constexpr int kEnd = -1;  // no row has so many columns
  add(&kEnd, sizeof(kEnd));
}

std::string ContentDigest::hexadecimal() {
  std::array<unsigned char, crypto_generichash_BYTES> hash{};
  crypto_generichash_final(&state_, hash.data(), hash.size());
  std::array<char, 2 * crypto_generichash_BYTES + 1> text{};
  return sodium_bin2hex(text.data(), text.size(), hash.data(), hash.size());
}

}  // namespace homeward::db
