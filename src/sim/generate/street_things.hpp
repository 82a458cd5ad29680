// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "sim/generate/builder.hpp"
#include "sim/random.hpp"

namespace homeward::sim {

/// The front of a house as it is painted.
struct Facade {
  int material = 0;
  double width_m = 8.0;
  double height_m = 8.0;
};

/// What a street is made of, painted once and used again and again.
struct StreetMaterials {
  std::vector<Facade> facades;
  std::vector<int> lit_windows;
  std::vector<int> notices;
  std::vector<int> cars;
  std::vector<Surface> leaves;
  std::vector<Surface> cloths;
  Surface bricks;
  Surface bark;
  Surface wood;
  Surface steel;
  Surface red;
  Surface stone;
  int lamp = 0;
};
StreetMaterials street_materials(SceneBuilder& scene, Random& random);

/// Shuts one side of a street from end to end: houses, hedges, walls, fences, and bays where a car is parked. The
/// street lies at y > 0 of `frame` and the side runs from x = 0 to `length_m`; nothing stands before y = 0. `houses`:
/// how many of ten pieces are houses.
void build_street_side(SceneBuilder& scene, const Pose2& frame, double length_m, int houses, const StreetMaterials& of,
                       Random& random);

/// What stands along a side within `deep_m` of it: trees, benches, planters, stalls, signs.
void dress_street_side(SceneBuilder& scene, const Pose2& frame, double length_m, double deep_m,
                       const StreetMaterials& of, Random& random);

/// A tree at the frame's origin: a trunk, and a crown above the height of people.
void build_tree(SceneBuilder& scene, const Pose2& frame, double height_m, const StreetMaterials& of, Random& random);

/// A lamp on a post at the frame's origin.
Lamp build_lamp_post(SceneBuilder& scene, const Pose2& frame, const StreetMaterials& of);

}  // namespace homeward::sim
