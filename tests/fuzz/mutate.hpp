// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

namespace homeward::testing {

using Bytes = std::vector<std::uint8_t>;

/// Damages bytes in the ways files and messages are damaged, and in those that somebody means harm with. Deterministic.
class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  /// One to four damages at once.
  Bytes damaged(Bytes bytes) {
    const std::size_t times = 1 + random_() % 4;
    for (std::size_t i = 0; i < times; ++i) damage(bytes);
    return bytes;
  }

  /// The same for text, which also gets its numbers and words exchanged.
  std::string damaged(const std::string& text) {
    Bytes bytes(text.begin(), text.end());
    if (random_() % 2 == 0) exchange_word(bytes);
    if (random_() % 3 != 0) damage(bytes);
    return {bytes.begin(), bytes.end()};
  }

 private:
  std::size_t below(std::size_t count) { return random_() % std::max<std::size_t>(1, count); }

  void damage(Bytes& bytes) {
    if (bytes.empty()) bytes.push_back(0);
    const std::size_t at = below(bytes.size());
    const auto here = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    const std::size_t length = std::min(bytes.size() - at, 1 + below(24));
    const auto there = here + static_cast<std::ptrdiff_t>(length);
    switch (random_() % 7) {
      case 0:
        *here ^= static_cast<std::uint8_t>(1U << (random_() % 8));
        break;
      case 1: {  // numbers at the limits of their kind
        constexpr std::array<std::uint8_t, 8> kEdges = {0x00, 0x01, 0x7F, 0x80, 0xFF, 0xFE, 0x40, 0x20};
        std::fill(here, std::min(there, here + 4), kEdges[random_() % kEdges.size()]);
        break;
      }
      case 2:
        bytes.erase(here, there);
        break;
      case 3: {
        const Bytes copy(here, there);
        bytes.insert(here, copy.begin(), copy.end());
        break;
      }
      case 4:
        bytes.resize(at);
        break;
      case 5:
        bytes.insert(here, static_cast<std::uint8_t>(random_()));
        break;
      default: {
        const Bytes copy(here, there);
        const std::size_t to = below(bytes.size() - length + 1);
        std::copy(copy.begin(), copy.end(), bytes.begin() + static_cast<std::ptrdiff_t>(to));
        break;
      }
    }
  }

  void exchange_word(Bytes& bytes) {
    static const std::array<std::string, 18> kWords = {
        "0",    "-1",   "1e999", "-1e308", "1e-320",     "9223372036854775808",
        "null", "true", "[]",    "{}",     "\"\"",       "\"\\u0000\"",
        "nan",  "[[]]", "0.5",   "\"x\"",  "4294967297", "\"\xC3\x28\""};
    const auto is_word = [](std::uint8_t c) {
      return std::isalnum(c) != 0 || c == '.' || c == '-' || c == '"' || c == '_';
    };
    std::size_t from = below(bytes.size());
    while (from < bytes.size() && !is_word(bytes[from])) ++from;
    std::size_t to = from;
    while (to < bytes.size() && is_word(bytes[to])) ++to;
    const std::string& word = kWords[random_() % kWords.size()];
    const auto here =
        bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(from), bytes.begin() + static_cast<std::ptrdiff_t>(to));
    bytes.insert(here, word.begin(), word.end());
  }

  std::mt19937_64 random_;
};

/// The files of a folder, in name order.
inline std::vector<std::string> texts_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> texts;
  for (const auto& file : files) {
    std::ifstream stream(file, std::ios::binary);
    texts.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  return texts;
}

}  // namespace homeward::testing
