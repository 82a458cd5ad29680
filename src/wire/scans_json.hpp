// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/range_sweep.hpp"
#include "core/result.hpp"

namespace homeward::wire {

inline constexpr std::size_t kMostRays = 10'000;  // of one sweep

/// scans.json (proto/schemas/scans.schema.json): where the rays of a tour's sweeps point, what the farthest range is,
/// and where on the robot the scanner stands. Of a sweep all but its ranges.
nlohmann::json scans_to_json(const RangeSweep& geometry);

/// Strict. The sweep has no ranges. Errors: kInvalidInput, kUnsupportedFormat; each names the field.
Result<RangeSweep> scans_from_json(const nlohmann::json& value, const std::string& path = "scans");

/// The same from text.
Result<RangeSweep> parse_scans(const std::string& text, const std::string& where);

/// One sweep with its ranges (proto/schemas/sweep.schema.json), in whole millimetres; null where nothing was
/// seen, or further than 100 km.
nlohmann::json sweep_to_json(const RangeSweep& sweep);

/// Strict. What is null becomes infinite. Errors: kInvalidInput (also more than kMostRays); each names the field.
Result<RangeSweep> sweep_from_json(const nlohmann::json& value, const std::string& path = "sweep");

}  // namespace homeward::wire
