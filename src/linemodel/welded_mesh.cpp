// SPDX-License-Identifier: Apache-2.0
#include "linemodel/welded_mesh.hpp"

#include <Eigen/Geometry>

namespace homeward::linemodel {

WeldedMesh weld(const raycast::Vertices& vertices_m, const raycast::Triangles& triangles, float within_m) {
  WeldedMesh mesh;
  PointGrid grid(within_m);
  std::vector<int> point_of(static_cast<std::size_t>(vertices_m.rows()));
  for (Eigen::Index row = 0; row < vertices_m.rows(); ++row) {
    const Eigen::Vector3f vertex_m = vertices_m.row(row).transpose();
    int nearest = -1;
    float nearest_m = within_m;
    grid.visit_near(vertex_m, [&](int index) {
      const float away_m = (mesh.points_m[static_cast<std::size_t>(index)] - vertex_m).norm();
      if (away_m > nearest_m || (away_m == nearest_m && nearest >= 0)) return;
      nearest = index;
      nearest_m = away_m;
    });
    if (nearest < 0) {
      nearest = static_cast<int>(mesh.points_m.size());
      mesh.points_m.push_back(vertex_m);
      grid.add(vertex_m, nearest);
    }
    point_of[static_cast<std::size_t>(row)] = nearest;
  }
  for (Eigen::Index row = 0; row < triangles.rows(); ++row) {
    std::array<int, 3> corners;
    for (Eigen::Index k = 0; k < 3; ++k) {
      corners[static_cast<std::size_t>(k)] = point_of[static_cast<std::size_t>(triangles(row, k))];
    }
    const auto point = [&](std::size_t k) { return mesh.points_m[static_cast<std::size_t>(corners[k])]; };
    const Eigen::Vector3f normal = (point(1) - point(0)).cross(point(2) - point(0));
    if (normal.norm() > 1e-9F) mesh.triangles.push_back(corners);
  }
  return mesh;
}

}  // namespace homeward::linemodel
