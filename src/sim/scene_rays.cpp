// SPDX-License-Identifier: Apache-2.0
#include "sim/scene_rays.hpp"

#include <utility>

namespace homeward::sim {

raycast::RayScene rays_of(const Scene& scene) {
  std::vector<bool> panes;
  panes.reserve(scene.triangle_materials.size());
  for (const int material : scene.triangle_materials) {
    panes.push_back(scene.materials[static_cast<std::size_t>(material)].role == MaterialRole::kWindow);
  }
  return {scene.vertices_m, scene.triangles, std::move(panes)};
}

}  // namespace homeward::sim
