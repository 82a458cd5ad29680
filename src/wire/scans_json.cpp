// SPDX-License-Identifier: Apache-2.0
#include "wire/scans_json.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "wire/json_reader.hpp"

namespace homeward::wire {

using nlohmann::json;

namespace {

constexpr double kTurn_rad = 6.3;
constexpr double kFarthest_m = 100'000.0;

json geometry_to_json(const RangeSweep& geometry) {
  const Pose2& scanner = geometry.robot_from_scan;
  return {{"angle_min_rad", geometry.angle_min_rad},
          {"angle_step_rad", geometry.angle_step_rad},
          {"range_max_m", geometry.range_max_m},
          {"robot_from_scan", {{"x_m", scanner.x_m}, {"y_m", scanner.y_m}, {"theta_rad", scanner.theta_rad}}}};
}

RangeSweep geometry_in(ObjectReader& reader) {
  constexpr double kLeastStep_rad = 1e-4;
  constexpr double kMostStep_rad = 1.0;
  RangeSweep geometry;
  geometry.angle_min_rad = reader.number("angle_min_rad", -kTurn_rad, kTurn_rad);
  geometry.angle_step_rad = reader.number("angle_step_rad", -kMostStep_rad, kMostStep_rad);
  if (std::abs(geometry.angle_step_rad) < kLeastStep_rad)
    reader.problem("angle_step_rad", "'angle_step_rad' must not be so near to 0.");
  geometry.range_max_m = reader.number("range_max_m", 0.1, 1000.0);
  ObjectReader scanner(reader.value("robot_from_scan"), reader.path_of("robot_from_scan"));
  geometry.robot_from_scan = {scanner.number("x_m", -10.0, 10.0), scanner.number("y_m", -10.0, 10.0),
                              scanner.number("theta_rad", -kTurn_rad, kTurn_rad)};
  reader.close(scanner);
  return geometry;
}

}  // namespace

json scans_to_json(const RangeSweep& geometry) {
  json value = geometry_to_json(geometry);
  value["format"] = "homeward-scans";
  value["version"] = 1;
  return value;
}

Result<RangeSweep> scans_from_json(const json& value, const std::string& path) {
  ObjectReader reader(value, path);
  reader.format("homeward-scans", 1);
  RangeSweep geometry = geometry_in(reader);
  if (const Status status = reader.finish(); !status) return pass_on(status);
  return geometry;
}

Result<RangeSweep> parse_scans(const std::string& text, const std::string& where) {
  const Result<json> value = parse_json(text, where);
  if (!value) return pass_on(value);
  return scans_from_json(*value, where);
}

json sweep_to_json(const RangeSweep& sweep) {
  json value = geometry_to_json(sweep);
  json& ranges = value["ranges_m"] = json::array();
  for (const float range_m : sweep.ranges_m) {
    const bool seen = range_m <= kFarthest_m;  // not a number is not
    // What rounds to -0 becomes 0.
    ranges.push_back(seen ? json(std::round(static_cast<double>(range_m) * 1000.0) / 1000.0 + 0.0) : json());
  }
  return value;
}

Result<RangeSweep> sweep_from_json(const json& value, const std::string& path) {
  ObjectReader reader(value, path);
  const std::vector<json> ranges = reader.array("ranges_m", kMostRays);
  RangeSweep sweep = geometry_in(reader);
  if (ranges.empty()) reader.problem("ranges_m", "A sweep has one range at least.");
  sweep.ranges_m.reserve(ranges.size());
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const json& range = ranges[i];
    const double range_m = range.is_number() ? range.get<double>() : std::numeric_limits<double>::infinity();
    if (!range.is_null() && !(range_m >= 0.0 && range_m <= kFarthest_m)) {
      reader.problem("ranges_m/" + std::to_string(i), "A range is 0 to 100000 metres, or null.");
      continue;
    }
    sweep.ranges_m.push_back(static_cast<float>(range_m));
  }
  if (const Status status = reader.finish(); !status) return pass_on(status);
  return sweep;
}

}  // namespace homeward::wire
