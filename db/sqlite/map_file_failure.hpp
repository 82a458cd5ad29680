// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "core/result.hpp"

namespace homeward::db {

/// Carries an Error through the reading functions to load_map.
struct LoadFailure : std::runtime_error {
  explicit LoadFailure(Error failure) : std::runtime_error(failure.message), error(std::move(failure)) {}
  Error error;
};

/// Throws LoadFailure (kCorruptFile).
[[noreturn]] inline void refuse_file(std::string message, std::string where = {}) {
  throw LoadFailure({ErrorCode::kCorruptFile, std::move(message), std::move(where)});
}

}  // namespace homeward::db
