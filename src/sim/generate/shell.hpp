// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/generate/builder.hpp"
#include "sim/generate/painting.hpp"

namespace homeward::sim {

inline constexpr double kCeiling_m = 2.6;
inline constexpr double kHalfWall_m = 0.06;

enum class Side { kSouth, kEast, kNorth, kWest };

/// A passage in a wall between two spaces, around `centre_m` on the wall's centre line; above a sill it is a glazed
/// panel, which is seen through.
struct Doorway {
  Eigen::Vector2d centre_m;
  bool in_x_wall = true;  // the wall runs along x
  double width_m = 1.1;
  double height_m = 2.1;
  bool leaf = true;  // a door stands open beside it
  double sill_m = 0.0;
  bool turned = false;  // the leaf rests on the other side of the wall, at the other jamb
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
  std::optional<Surface> rail = std::nullopt;  // a rail to hold on to and to stop beds, along all walls
  bool turned = false;                         // floor and ceiling are laid half a turn round
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

/// The linings of the doorways' walls, once for each doorway; the frames and bars of glazed panels. Returns those that
/// are gone through.
std::vector<DoorOpening> build_linings(SceneBuilder& scene, const std::vector<Doorway>& doorways, Random& random);

/// Shells and linings that look the same from space to space and from doorway to doorway. Returns what build_linings
/// does.
std::vector<DoorOpening> build_like_shells(SceneBuilder& scene, const std::vector<Space>& spaces,
                                           const std::vector<Doorway>& doorways, std::uint64_t seed);

/// A door that is shut: it stands before the wall at y = 0 of `frame`, which looks along +y. Looks as the leaves do
/// that `build_linings` builds of the same `random`.
void build_shut_door(SceneBuilder& scene, const Pose2& frame, Random& random);

/// The leaf of a door, in its doorway: shut.
void build_leaf(SceneBuilder& scene, const DoorOpening& door, Random& random);

/// A ceiling lamp with its light.
Lamp build_lamp(SceneBuilder& scene, const Eigen::Vector2d& position_m, double strength, Random& random);

}  // namespace homeward::sim
