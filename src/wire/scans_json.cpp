// SPDX-License-Identifier: Apache-2.0
#include "wire/scans_json.hpp"

#include <cmath>

#include "wire/json_reader.hpp"

namespace homeward::wire {

using nlohmann::json;

json scans_to_json(const RangeSweep& geometry) {
  const Pose2& scanner = geometry.robot_from_scan;
  return {{"format", "homeward-scans"},
          {"version", 1},
          {"angle_min_rad", geometry.angle_min_rad},
          {"angle_step_rad", geometry.angle_step_rad},
          {"range_max_m", geometry.range_max_m},
          {"robot_from_scan", {{"x_m", scanner.x_m}, {"y_m", scanner.y_m}, {"theta_rad", scanner.theta_rad}}}};
}

Result<RangeSweep> scans_from_json(const json& value, const std::string& path) {
  constexpr double kTurn_rad = 6.3;
  constexpr double kLeastStep_rad = 1e-4;
  constexpr double kMostStep_rad = 1.0;
  ObjectReader reader(value, path);
  reader.format("homeward-scans", 1);
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
  if (const Status status = reader.finish(); !status) return pass_on(status);
  return geometry;
}

Result<RangeSweep> parse_scans(const std::string& text, const std::string& where) {
  const Result<json> value = parse_json(text, where);
  if (!value) return pass_on(value);
  return scans_from_json(*value, where);
}

}  // namespace homeward::wire
