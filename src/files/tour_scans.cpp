// SPDX-License-Identifier: Apache-2.0
#include "files/tour_scans.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <string_view>
#include <vector>

#include "core/angles.hpp"
#include "files/read_file.hpp"
#include "wire/scans_json.hpp"

namespace homeward::files {
namespace {

namespace fs = std::filesystem;

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t comma = line.find(',');
    cells.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

/// Infinity for an empty cell; nothing for what is no range.
std::optional<float> range_of(std::string_view cell) {
  if (cell.empty()) return std::numeric_limits<float>::infinity();
  float value = 0.0F;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size()) return std::nullopt;
  if (!std::isfinite(value) || value < 0.0F) return std::nullopt;
  return value;
}

/// The number of rays that the first line names.
Result<std::size_t> rays_of(std::string_view line, const std::string& where) {
  const auto cells = cells_of(line);
  bool right = cells.size() > 1 && cells[0] == "filename";
  for (std::size_t i = 1; right && i < cells.size(); ++i) right = cells[i] == "r" + std::to_string(i - 1);
  if (!right) return fail(ErrorCode::kInvalidInput, "The first line has to be \"filename,r0,r1,...\".", where);
  if (cells.size() - 1 > wire::kMostRays) {
    return fail(ErrorCode::kTooLarge, "A sweep may have " + std::to_string(wire::kMostRays) + " rays at most.", where);
  }
  return cells.size() - 1;
}

Result<RangeSweep> sweep_of(const std::vector<std::string_view>& cells, std::size_t rays, const RangeSweep& geometry,
                            const std::string& where) {
  if (cells.size() != rays + 1) {
    return fail(ErrorCode::kInvalidInput, "The line has to have " + std::to_string(rays + 1) + " columns.", where);
  }
  if (cells[0].empty()) return fail(ErrorCode::kInvalidInput, "The line has to name a picture.", where);
  RangeSweep sweep = geometry;
  sweep.ranges_m.reserve(rays);
  for (std::size_t i = 0; i < rays; ++i) {
    const auto range_m = range_of(cells[i + 1]);
    if (!range_m) {
      return fail(ErrorCode::kInvalidInput,
                  "Column r" + std::to_string(i) + " has to hold metres from 0 on, or nothing.", where);
    }
    sweep.ranges_m.push_back(*range_m);
  }
  return sweep;
}

/// `geometry`: nothing for a whole turn of as many rays as the first line names.
Result<std::map<std::string, RangeSweep>> sweeps_of(const fs::path& table, std::optional<RangeSweep> geometry) {
  std::map<std::string, RangeSweep> sweeps;
  const auto text = read_text(table);
  if (!text) return pass_on(text);
  std::istringstream lines(*text);
  std::string line;
  std::size_t rays = 0;
  for (int number = 1; std::getline(lines, line); ++number) {
    const std::string where = table.string() + ":" + std::to_string(number);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (number == 1) {
      const auto named = rays_of(line, where);
      if (!named) return pass_on(named);
      rays = *named;
      if (!geometry) geometry = RangeSweep{{}, 0.0, 2.0 * kPi / static_cast<double>(rays), 12.0, {}};
      continue;
    }
    if (line.empty()) continue;
    const auto cells = cells_of(line);
    auto sweep = sweep_of(cells, rays, *geometry, where);
    if (!sweep) return pass_on(sweep);
    if (sweeps.size() == kMostSweeps) {
      return fail(ErrorCode::kTooLarge, "A tour may have " + std::to_string(kMostSweeps) + " sweeps at most.", where);
    }
    const std::string picture(cells[0]);
    if (!sweeps.emplace(picture, std::move(*sweep)).second) {
      return fail(ErrorCode::kInvalidInput, "The picture " + picture + " has a sweep already.", where);
    }
  }
  if (rays == 0)
    return fail(ErrorCode::kInvalidInput, "The first line has to be \"filename,r0,r1,...\".", table.string() + ":1");
  return sweeps;
}

}  // namespace

Result<std::map<std::string, RangeSweep>> read_scans(const fs::path& folder) {
  const fs::path table = folder / "scans.csv";
  const fs::path about = folder / "scans.json";
  std::error_code error;
  if (!fs::exists(table, error) || !fs::exists(about, error)) return std::map<std::string, RangeSweep>();
  const auto about_text = read_text(about);
  if (!about_text) return pass_on(about_text);
  const auto geometry = wire::parse_scans(*about_text, about.string());
  if (!geometry) return pass_on(geometry);
  return sweeps_of(table, *geometry);
}

Result<std::map<std::string, RangeSweep>> read_scans_table(const fs::path& table) {
  const fs::path about = table.parent_path() / "scans.json";
  std::error_code error;
  if (!fs::exists(about, error)) return sweeps_of(table, std::nullopt);
  const auto about_text = read_text(about);
  if (!about_text) return pass_on(about_text);
  const auto geometry = wire::parse_scans(*about_text, about.string());
  if (!geometry) return pass_on(geometry);
  return sweeps_of(table, *geometry);
}

}  // namespace homeward::files
