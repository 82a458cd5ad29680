// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>
#include <string>

namespace homeward::db {

/// What a failure says, for a message: in one line of plain ASCII. SQLite quotes what stands in a file, and in a
/// damaged one that may be anything.
inline std::string words_of(const std::exception& failure) {
  std::string words = failure.what();
  for (char& c : words) {
    if (c < 0x20 || c > 0x7E) c = '?';
  }
  return words;
}

}  // namespace homeward::db
