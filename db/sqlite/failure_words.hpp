// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>
#include <string>

#include "wire/json_reader.hpp"

namespace homeward::db {

/// What a failure says, for a message: in one line of plain ASCII. SQLite quotes what stands in a file, and in a
/// damaged one that may be anything.
inline std::string words_of(const std::exception& failure) {
  constexpr std::size_t kMost_bytes = 500;
  return wire::shown(std::string(failure.what()), kMost_bytes);
}

}  // namespace homeward::db
