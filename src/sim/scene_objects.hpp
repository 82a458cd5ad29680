// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/scene.hpp"

namespace homeward::sim {

/// Something that stands in a building and may stand elsewhere or be gone tomorrow.
struct SceneObject {
  std::vector<Eigen::Index> triangles;  // of the scene, ascending; no other triangle shares a vertex with them
  Eigen::Vector3f least_m = Eigen::Vector3f::Constant(1e9F);
  Eigen::Vector3f most_m = Eigen::Vector3f::Constant(-1e9F);
  bool movable = true;  // not built in or hung on a wall
};

/// The objects of a world. A generated one knows its furniture. Of a mesh (ours): triangles that hang together, as far
/// as they are smaller than a room (3 m), no covering of the floor and no leaf or frame of a door; what touches, by the
/// boxes around it, is one object (a table and what stands on it); one that does not stand on the floor is none, nor is
/// a group that together is as large as a room.
std::vector<SceneObject> objects_of(const World& world);

}  // namespace homeward::sim
