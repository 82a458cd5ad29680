// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "core/range_sweep.hpp"
#include "core/result.hpp"

namespace homeward::files {

inline constexpr std::size_t kMostSweeps = 100'000;

/// The sweeps of a tour by picture: scans.csv, whose first line is "filename,r0,r1,...", with the geometry of
/// scans.json (wire/scans_json.hpp). A range is a number of metres from 0 on; an empty cell, or range_max_m and more,
/// saw nothing. A folder without scans.json has none: nothing then says where the rays of its scans.csv point.
/// Errors: those of read_text and of wire::parse_scans; kInvalidInput (file, line and column of what is wrong),
/// kTooLarge (more than wire::kMostRays or kMostSweeps).
Result<std::map<std::string, RangeSweep>> read_scans(const std::filesystem::path& folder);

/// The same of one table, wherever it is, with the scans.json beside it. Without one its rays are taken to be spread
/// evenly over a whole turn from straight ahead, counter-clockwise, and to reach 12 m. Errors: those of read_scans,
/// kNotFound.
Result<std::map<std::string, RangeSweep>> read_scans_table(const std::filesystem::path& table);

}  // namespace homeward::files
