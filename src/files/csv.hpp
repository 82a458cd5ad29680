// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"

namespace homeward::files {

/// A table with a first line of column names; no quotes, fields are trimmed.
struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  // each as long as columns
  [[nodiscard]] std::optional<std::size_t> column(const std::string& name) const;
};

/// Errors: those of read_text; kInvalidInput with the line whose number of fields is not that of the first line.
Result<CsvTable> read_csv(const std::filesystem::path& file);

}  // namespace homeward::files
