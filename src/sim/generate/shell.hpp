// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "sim/generate/builder.hpp"
#include "sim/generate/painting.hpp"

namespace homeward::sim {

inline constexpr double kCeiling_m = 2.6;
inline constexpr double kHalfWall_m = 0.06;

enum class Side { kSouth, kEast, kNorth, kWest };

/// A passage in a wall between two spaces, around `centre_m` on the wall's centre line.
struct Doorway {
  Eigen::Vector2d centre_m;
  bool in_x_wall = true;  // the wall runs along x
  double width_m = 1.1;
  double height_m = 2.1;
  bool leaf = true;  // a door stands open beside it
};

struct WindowOpening {
  Side side = Side::kSouth;
  double centre_m = 0.0;  // along the wall from its left end, seen from inside
  double width_m = 1.6;
  bool curtains_drawn = false;
};

/// A room or corridor: a rectangle between wall centre lines.
struct Space {
  std::string name;
  Eigen::Vector2d least_m;
  Eigen::Vector2d most_m;
  Surface floor;
  Surface wall;
  Surface ceiling;
  std::vector<WindowOpening> windows;
};

/// A wall of a space seen from inside: the frame stands at its left end on the floor with +x along the wall to the
/// right... and +y into the room; pieces look into the room.
struct WallFrame {
  Pose2 frame;
  double length_m = 0.0;
};
WallFrame wall_frame(const Space& space, Side side);

/// Where along a wall (from its left end) the doorways lie: pairs of from and to.
std::vector<std::pair<double, double>> openings_of(const Space& space, Side side, const std::vector<Doorway>& doorways);

/// Floor, ceiling, walls with their openings, skirting, windows with a view, and door leaves.
void build_shell(SceneBuilder& scene, const Space& space, const std::vector<Doorway>& doorways, Random& random);

/// The linings of the doorways' walls, once for each doorway.
void build_linings(SceneBuilder& scene, const std::vector<Doorway>& doorways, Random& random);

/// A ceiling lamp with its light.
Lamp build_lamp(SceneBuilder& scene, const Eigen::Vector2d& position_m, double strength, Random& random);

}  // namespace homeward::sim
