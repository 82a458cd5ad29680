// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace homeward::testing {

/// Reads the part of YAML that proto/ is written in: maps and lists in block and flow style, plain and single-quoted
/// text, text over several lines, ">-" and "|" blocks. Throws std::runtime_error with the number of a line that it
/// does not understand, or that repeats a key.
nlohmann::json parse_yaml(const std::string& text);

}  // namespace homeward::testing
