// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "sim/generate/shell.hpp"

namespace homeward::sim {

/// The sizes of a hospital. From south to north: wards, a corridor, the middle with its bays, halls and cross
/// corridors, the other corridor, wards. From west to east it is made of modules of one length, each with a ward on
/// either side. A half is seen from its own frame: +x along the corridor, +y from the outer wall inwards; the northern
/// half's is the southern one's turned round.
struct WardsPlan {
  int modules = 5;
  double module_m = 9.0;
  double width_m = 22.0;
  double ward_m = 5.5;      // depth of a ward
  double corridor_m = 2.4;  // width of a corridor
  double cross_m = 2.4;
  std::vector<bool> crosses;     // whether a module's middle is a cross corridor between bays; else it is a hall
  Eigen::Vector2d floor_tile_m;  // what is laid again and again; whole numbers of it fill the building
  Eigen::Vector2d ceiling_tile_m;
  double wall_tile_m = 3.0;

  [[nodiscard]] double length_m() const { return modules * module_m; }
  [[nodiscard]] double middle_m() const { return width_m - 2.0 * (ward_m + corridor_m); }
  /// Where module `index` of a half begins, index 0 at the half's own left.
  [[nodiscard]] Pose2 module_frame(bool north, int index) const;
  /// Whether that module's middle is a cross corridor between bays.
  [[nodiscard]] bool has_cross(bool north, int index) const;
  /// Whether that module's hall has its door to this half's corridor; the other corridor looks in through glass.
  [[nodiscard]] bool has_hall_door(bool north, int index) const;
};

/// Sizes and patterns at random: 20.5 to 26 m by 40 to 56 m, two to four cross corridors.
WardsPlan plan_wards(Random& random);

/// What every wall, floor and ceiling of the hospital is covered with.
struct WardsSurfaces {
  Surface floor;
  Surface wall;
  Surface ceiling;
  Surface rail;
};

/// Corridors first, then cross corridors, wards, halls and bays.
std::vector<Space> spaces_of(const WardsPlan& plan, const WardsSurfaces& surfaces);

/// Doors, open fronts and glazed panels.
std::vector<Doorway> doorways_of(const WardsPlan& plan);

/// Where the door of a ward is, from the module's beginning.
double ward_door_m(const WardsPlan& plan);
/// Where the glazed panel of a ward is. Every other ward has one.
double ward_panel_m(const WardsPlan& plan);
/// Where a door that is always shut is painted beside every ward.
double shut_door_m(const WardsPlan& plan);

}  // namespace homeward::sim
