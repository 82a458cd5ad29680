// SPDX-License-Identifier: Apache-2.0
#include "sim/tessellate.hpp"

#include <array>

#include "sim/triangles.hpp"

namespace homeward::sim {
namespace {

void split(const std::array<Corner, 3>& corners, int material, float max_edge2, int depth, LooseTriangles& triangles) {
  std::size_t longest = 0;
  float longest2 = 0.0F;
  for (std::size_t i = 0; i < 3; ++i) {
    const float edge2 = (corners[(i + 1) % 3].position_m - corners[i].position_m).squaredNorm();
    if (edge2 > longest2) {
      longest2 = edge2;
      longest = i;
    }
  }
  if (longest2 <= max_edge2 || depth == 0) {
    triangles.add(corners, material);
    return;
  }
  const Corner& a = corners[longest];
  const Corner& b = corners[(longest + 1) % 3];
  const Corner& c = corners[(longest + 2) % 3];
  const Corner middle{0.5F * (a.position_m + b.position_m), 0.5F * (a.uv + b.uv)};
  split({a, middle, c}, material, max_edge2, depth - 1, triangles);
  split({middle, b, c}, material, max_edge2, depth - 1, triangles);
}

}  // namespace

Scene tessellate(const Scene& scene, float max_edge_m) {
  constexpr int kMaxDepth = 16;
  LooseTriangles triangles;
  for (Eigen::Index t = 0; t < scene.triangles.rows(); ++t) {
    std::array<Corner, 3> corners;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const Eigen::Index vertex = scene.triangles(t, k);
      corners[static_cast<std::size_t>(k)] = {scene.vertices_m.row(vertex), scene.texture_uv.row(vertex)};
    }
    split(corners, scene.triangle_materials[static_cast<std::size_t>(t)], max_edge_m * max_edge_m, kMaxDepth,
          triangles);
  }
  Scene fine = triangles.take();
  fine.materials = scene.materials;
  fine.textures = scene.textures;
  return fine;
}

}  // namespace homeward::sim
