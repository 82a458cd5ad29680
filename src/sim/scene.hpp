// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/image.hpp"
#include "core/pose2.hpp"

namespace homeward::sim {

enum class MaterialRole { kNone, kFloor, kCeiling, kWindow, kLamp };

struct Material {
  std::string name;
  std::array<float, 3> base_colour{0.8F, 0.8F, 0.8F};  // linear factor of the texture, 0..1
  int texture = -1;                                    // index into Scene::textures, -1: none
  MaterialRole role = MaterialRole::kNone;
};

/// Triangles of a building. World frame, metres, z up. Plain data, whatever it was made from.
struct Scene {
  Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> vertices_m;        // V x 3
  Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor> texture_uv;        // V x 2, v downwards from the top row
  Eigen::Matrix<std::int32_t, Eigen::Dynamic, 3, Eigen::RowMajor> triangles;  // T x 3, vertex indices
  std::vector<int> triangle_materials;                                        // T, index into materials
  std::vector<Material> materials;
  std::vector<Image> textures;
};

struct Room {
  std::string name;
  double x_m = 0.0;
  double y_m = 0.0;
  std::vector<Eigen::Vector2d> outline_m;  // polygon on the floor; may be empty (unknown)
};

struct Lamp {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  double strength = 1.0;
};

/// A piece of furniture: the scene's triangles from `first` on, which share no vertices with others.
struct Furniture {
  std::string room;  // by name; empty in a space without one
  Eigen::Index first = 0;
  Eigen::Index count = 0;
  bool movable = true;  // not built in or hung on a wall
};

/// A doorway, which a door may shut.
struct DoorOpening {
  Pose2 frame;  // its middle on the floor, x along the wall
  double width_m = 0.0;
  double height_m = 0.0;
  Eigen::Index first = 0;  // triangles of the leaf that stands open beside it, which share no vertices with others
  Eigen::Index count = 0;  // 0: it has none
};

/// Cells of the floor, row 0 at the largest y, like ROS map_server.
struct FloorGrid {  // see floor.hpp for what is computed on it
  int width = 0;
  int height = 0;
  double resolution_m = 0.05;
  Eigen::Vector2d origin_m = Eigen::Vector2d::Zero();  // lower left corner
  std::vector<std::uint8_t> cells;                     // height x width, 255 = yes, 0 = no
  double robot_radius_m = 0.35;
};

/// The sky over a world that has no ceiling.
struct Sky {
  double sun_azimuth_rad = 0.0;  // where the sun stands, counter-clockwise from the world's +x
};

/// A building to drive in: what world.json describes, loaded.
struct World {
  std::string name;
  Scene scene;
  Pose2 start;
  std::vector<Room> rooms;
  std::vector<Lamp> lamps;
  std::vector<Furniture> furniture;  // known of generated worlds alone
  std::vector<DoorOpening> doors;    // the same
  bool round = false;                // its rooms lie round a circuit, in their order
  std::optional<Sky> sky;            // of a world in the open
  FloorGrid occupied;                // 255 = something stands there between knee and head
  FloorGrid
      drivable;  // 255 = the centre of a disc robot of robot_radius_m may be here, and can get here from the start
};

}  // namespace homeward::sim
