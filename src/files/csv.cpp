// SPDX-License-Identifier: Apache-2.0
#include "files/csv.hpp"

#include <algorithm>
#include <sstream>

#include "files/read_file.hpp"

namespace homeward::files {
namespace {

std::string trimmed(const std::string& text) {
  constexpr const char* kSpace = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kSpace);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> result;
  std::size_t begin = 0;
  for (;;) {
    const std::size_t comma = line.find(',', begin);
    result.push_back(trimmed(line.substr(begin, comma == std::string::npos ? std::string::npos : comma - begin)));
    if (comma == std::string::npos) return result;
    begin = comma + 1;
  }
}

}  // namespace

std::optional<std::size_t> CsvTable::column(const std::string& name) const {
  const auto found = std::find(columns.begin(), columns.end(), name);
  if (found == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns.begin());
}

Result<CsvTable> read_csv(const std::filesystem::path& file) {
  const auto text = read_text(file);
  if (!text) return pass_on(text);
  std::istringstream stream(*text);
  CsvTable table;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (trimmed(line).empty()) continue;
    if (table.columns.empty()) {
      table.columns = fields(line);
      continue;
    }
    table.rows.push_back(fields(line));
    if (table.rows.back().size() != table.columns.size()) {
      return fail(ErrorCode::kInvalidInput,
                  "The line has " + std::to_string(table.rows.back().size()) + " fields where the first line names " +
                      std::to_string(table.columns.size()) + ".",
                  file.string() + ":" + std::to_string(number));
    }
  }
  if (table.columns.empty()) return fail(ErrorCode::kEmptyInput, "The table is empty.", file.string());
  return table;
}

}  // namespace homeward::files
