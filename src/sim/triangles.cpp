// SPDX-License-Identifier: Apache-2.0
#include "sim/triangles.hpp"

#include <utility>

namespace homeward::sim {

void LooseTriangles::add(const std::array<Corner, 3>& corners, int material) {
  corners_.insert(corners_.end(), corners.begin(), corners.end());
  materials_.push_back(material);
}

Scene LooseTriangles::take() {
  Scene scene;
  const auto corners = static_cast<Eigen::Index>(corners_.size());
  scene.vertices_m.resize(corners, 3);
  scene.texture_uv.resize(corners, 2);
  scene.triangles.resize(corners / 3, 3);
  for (Eigen::Index i = 0; i < corners; ++i) {
    scene.vertices_m.row(i) = corners_[static_cast<std::size_t>(i)].position_m;
    scene.texture_uv.row(i) = corners_[static_cast<std::size_t>(i)].uv;
    scene.triangles(i / 3, i % 3) = static_cast<std::int32_t>(i);
  }
  scene.triangle_materials = std::exchange(materials_, {});
  corners_ = {};
  return scene;
}

std::array<Eigen::Vector3d, 3> corners_m(const Scene& scene, Eigen::Index triangle) {
  std::array<Eigen::Vector3d, 3> corners;
  for (Eigen::Index k = 0; k < 3; ++k) {
    corners[static_cast<std::size_t>(k)] =
        scene.vertices_m.row(scene.triangles(triangle, k)).transpose().cast<double>();
  }
  return corners;
}

FloorExtent floor_extent(const Scene& scene) {
  return {scene.vertices_m.leftCols<2>().colwise().minCoeff().transpose().cast<double>(),
          scene.vertices_m.leftCols<2>().colwise().maxCoeff().transpose().cast<double>()};
}

}  // namespace homeward::sim
