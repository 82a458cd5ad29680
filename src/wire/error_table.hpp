// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

#include "core/result.hpp"

namespace homeward::wire {

/// What an error code is called and means outside: on the wire, in a browser, to a shell.
struct ErrorRow {
  ErrorCode code;
  std::string_view name;   // snake_case, the "code" of a problem document
  std::string_view title;  // a short sentence that fits every error of this code
  int http_status;
  int exit_code;
};

/// One row for each code, in the order of the enumeration.
std::span<const ErrorRow> error_table();
const ErrorRow& error_row(ErrorCode code);
/// The code of a name, or nothing.
const ErrorRow* error_row(std::string_view name);

inline int exit_code(ErrorCode code) { return error_row(code).exit_code; }
inline int http_status(ErrorCode code) { return error_row(code).http_status; }
inline std::string_view error_name(ErrorCode code) { return error_row(code).name; }

}  // namespace homeward::wire
