// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/pose2.hpp"
#include "core/result.hpp"

namespace homeward::wire {

/// A grey picture (PGM) of the floor: row 0 at the largest y, 255 = yes.
struct FloorPicture {
  std::string image;  // file name beside world.json
  double resolution_m = 0.05;
  Eigen::Vector2d origin_m = Eigen::Vector2d::Zero();  // lower left corner
  double robot_radius_m = 0.35;                        // only of a drivable area
};

struct WorldRoom {
  std::string name;
  double x_m = 0.0;
  double y_m = 0.0;
  std::vector<Eigen::Vector2d> outline_m;  // empty: not known
};

struct WorldLamp {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  double strength = 1.0;
};

/// world.json (proto/schemas/world.schema.json), format "homeward-world", version 1.
struct WorldFile {
  std::string name;
  std::string mesh;  // file name beside world.json
  bool mesh_y_up = false;
  bool outdoor = false;
  Pose2 start;
  std::vector<WorldRoom> rooms;
  std::vector<WorldLamp> lamps;
  std::optional<FloorPicture> occupancy;  // 0 = something stands there
  std::optional<FloorPicture> drivable;
};

nlohmann::json world_to_json(const WorldFile& world);
/// Strict. Errors: kInvalidInput, kUnsupportedFormat; each names the field.
Result<WorldFile> world_from_json(const nlohmann::json& value, const std::string& path = "world");
Result<WorldFile> parse_world(const std::string& text, const std::string& where);

}  // namespace homeward::wire
