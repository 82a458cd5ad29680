// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "sim/generate/furniture.hpp"
#include "sim/generate/shell.hpp"

namespace homeward::sim {

/// What stands and hangs along the walls of corridors, painted once and used again and again.
struct CorridorMaterials {
  std::vector<int> pictures;
  std::vector<int> notices;
  std::vector<Surface> doors;
  std::vector<Surface> cloths;
  Surface wood;
  Surface steel;
  Surface radiator;
  Surface red;  // of fire extinguishers
  Surface cork;
  Surface frame;
};
CorridorMaterials corridor_materials(SceneBuilder& scene, Random& random);

/// Covers the free stretches of one wall of a corridor from end to end: doors that are shut, pictures, boards of
/// notices, radiators, fire extinguishers, and, where `deep`, benches and furniture of up to 0.45 m. What is not let
/// into the wall is returned as furniture.
std::vector<Furniture> dress_wall(SceneBuilder& scene, const Space& space, Side side,
                                  const std::vector<Doorway>& doorways, bool deep, const CorridorMaterials& of,
                                  Random& random);

/// The leaf of a door that stands open in the corridor, square to its doorway.
void build_open_leaf(SceneBuilder& scene, const Doorway& doorway, const CorridorMaterials& of, Random& random);

}  // namespace homeward::sim
