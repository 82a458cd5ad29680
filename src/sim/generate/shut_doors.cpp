// SPDX-License-Identifier: Apache-2.0
#include "sim/generate/shut_doors.hpp"

#include <algorithm>

#include "sim/floor.hpp"
#include "sim/generate/shell.hpp"

namespace homeward::sim {
namespace {

/// Puts the leaf that stands open beside a doorway into it.
void swing_shut(Scene& scene, const DoorOpening& door) {
  const Pose2 door_from_world = inverse(door.frame);
  const auto in_frame = [&](std::int32_t vertex) {
    return position_m(door_from_world * Pose2{scene.vertices_m(vertex, 0), scene.vertices_m(vertex, 1), 0.0});
  };
  Eigen::AlignedBox2d leaf;
  std::vector<std::int32_t> vertices;
  for (Eigen::Index t = door.first; t < door.first + door.count; ++t) {
    for (int corner = 0; corner < 3; ++corner) vertices.push_back(scene.triangles(t, corner));
  }
  std::ranges::sort(vertices);
  const auto repeated = std::ranges::unique(vertices);
  vertices.erase(repeated.begin(), repeated.end());
  for (const std::int32_t vertex : vertices) leaf.extend(in_frame(vertex));
  for (const std::int32_t vertex : vertices) {
    const Eigen::Vector2d off = in_frame(vertex) - leaf.center();
    const Pose2 there = door.frame * Pose2{off.x() * door.width_m / leaf.sizes().x(), off.y(), 0.0};
    scene.vertices_m(vertex, 0) = static_cast<float>(there.x_m);
    scene.vertices_m(vertex, 1) = static_cast<float>(there.y_m);
  }
}

/// The scene with another one in it, behind its own triangles.
void append(Scene& scene, Scene more) {
  const auto vertices = static_cast<std::int32_t>(scene.vertices_m.rows());
  const auto materials = static_cast<int>(scene.materials.size());
  const auto textures = static_cast<int>(scene.textures.size());
  const Eigen::Index triangles = scene.triangles.rows();
  scene.vertices_m.conservativeResize(vertices + more.vertices_m.rows(), 3);
  scene.vertices_m.bottomRows(more.vertices_m.rows()) = more.vertices_m;
  scene.texture_uv.conservativeResize(vertices + more.texture_uv.rows(), 2);
  scene.texture_uv.bottomRows(more.texture_uv.rows()) = more.texture_uv;
  scene.triangles.conservativeResize(triangles + more.triangles.rows(), 3);
  scene.triangles.bottomRows(more.triangles.rows()) = more.triangles.array() + vertices;
  for (const int material : more.triangle_materials) scene.triangle_materials.push_back(material + materials);
  for (Material& material : more.materials) {
    if (material.texture >= 0) material.texture += textures;
    scene.materials.push_back(std::move(material));
  }
  for (Image& texture : more.textures) scene.textures.push_back(std::move(texture));
}

}  // namespace

Result<ShutDoors> shut_doors(const World& world, double share, std::uint64_t seed) {
  if (world.doors.empty()) {
    return fail(ErrorCode::kInvalidInput,
                "Doors can be shut in generated worlds alone: this one does not say where its doors are.", world.name);
  }
  ShutDoors result{world, 0};
  Random random(seed * 6247 + 31);
  Random paint(seed * 6269 + 37);
  for (const DoorOpening& door : world.doors) {
    if (uniform(random, 0.0, 1.0) >= share) continue;
    ++result.shut;
    if (door.count > 0) {
      swing_shut(result.world.scene, door);
      continue;
    }
    SceneBuilder leaf;
    build_leaf(leaf, door, paint);
    append(result.world.scene, leaf.take());
  }
  if (result.shut == 0) return result;
  result.world.occupied = occupied_cells(result.world.scene, world.occupied.resolution_m);
  result.world.drivable = drivable_cells(result.world.occupied, world.drivable.robot_radius_m, world.start);
  return result;
}

}  // namespace homeward::sim
