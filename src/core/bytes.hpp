// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

namespace homeward {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in memory");

/// Numbers one after another as little endian bytes.
class ByteWriter {
 public:
  template <class T>
  void put(const T* values, std::size_t count) {
    const auto* first = reinterpret_cast<const std::uint8_t*>(values);
    bytes_.insert(bytes_.end(), first, first + count * sizeof(T));
  }
  template <class T>
  void put(T value) {
    put(&value, 1);
  }
  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  std::vector<std::uint8_t> bytes_;
};

/// Reads what a ByteWriter wrote, never past the end.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  /// False, with nothing read, where fewer bytes are left than `count` numbers take.
  template <class T>
  bool get(T* values, std::size_t count = 1) {
    if (count > bytes_.size() / sizeof(T)) return false;
    const std::size_t size = count * sizeof(T);
    if (size > 0) std::memcpy(values, bytes_.data(), size);
    bytes_ = bytes_.subspan(size);
    return true;
  }
  [[nodiscard]] std::size_t left() const { return bytes_.size(); }

 private:
  std::span<const std::uint8_t> bytes_;
};

}  // namespace homeward
