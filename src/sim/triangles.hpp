// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "sim/scene.hpp"

namespace homeward::sim {

/// One corner of a triangle.
struct Corner {
  Eigen::Vector3f position_m;
  Eigen::Vector2f uv;  // of the texture, v downwards
};

/// Triangles that share no vertices, one after another, as a scene holds them.
class LooseTriangles {
 public:
  /// `material`: an index into the materials that the scene will have.
  void add(const std::array<Corner, 3>& corners, int material);
  [[nodiscard]] Eigen::Index count() const { return static_cast<Eigen::Index>(materials_.size()); }
  /// The scene, its materials and textures left to the caller; no triangle is left here afterwards.
  Scene take();

 private:
  std::vector<Corner> corners_;
  std::vector<int> materials_;
};

/// The corners of a scene's triangle, metres in the world.
std::array<Eigen::Vector3d, 3> corners_m(const Scene& scene, Eigen::Index triangle);

/// The rectangle of the floor, along the world's axes, that a scene stands over.
struct FloorExtent {
  Eigen::Vector2d least_m;
  Eigen::Vector2d most_m;
};
/// Precondition: the scene has vertices.
FloorExtent floor_extent(const Scene& scene);

}  // namespace homeward::sim
