// SPDX-License-Identifier: Apache-2.0
#include "sim/scene_objects.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace homeward::sim {
namespace {

constexpr float kRoom_m = 3.0F;
constexpr float kGap_m = 0.01F;  // of what touches

/// Sets of elements that are joined two by two.
class JoinedSets {
 public:
  explicit JoinedSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t of(std::size_t element) {
    while (parent_[element] != element) {
      parent_[element] = parent_[parent_[element]];
      element = parent_[element];
    }
    return element;
  }
  void join(std::size_t a, std::size_t b) { parent_[std::max(of(a), of(b))] = std::min(of(a), of(b)); }

 private:
  std::vector<std::size_t> parent_;
};

void hold_triangle(SceneObject& object, const Scene& scene, Eigen::Index triangle) {
  object.triangles.push_back(triangle);
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Eigen::Vector3f corner_m = scene.vertices_m.row(scene.triangles(triangle, k)).transpose();
    object.least_m = object.least_m.cwiseMin(corner_m);
    object.most_m = object.most_m.cwiseMax(corner_m);
  }
}

/// Vertices of the same millimetre are one.
std::vector<std::size_t> same_vertices(const Scene& scene) {
  std::map<std::array<std::int64_t, 3>, std::size_t> known;
  std::vector<std::size_t> same(static_cast<std::size_t>(scene.vertices_m.rows()));
  for (std::size_t i = 0; i < same.size(); ++i) {
    const auto row = scene.vertices_m.row(static_cast<Eigen::Index>(i));
    const auto mm = [&](int axis) { return static_cast<std::int64_t>(std::lround(1000.0F * row(axis))); };
    same[i] = known.emplace(std::array{mm(0), mm(1), mm(2)}, i).first->second;
  }
  return same;
}

/// Triangles that hang together, in the order of their first ones.
std::vector<SceneObject> components(const Scene& scene) {
  const std::vector<std::size_t> same = same_vertices(scene);
  const auto vertex = [&](Eigen::Index triangle, Eigen::Index k) {
    return same[static_cast<std::size_t>(scene.triangles(triangle, k))];
  };
  JoinedSets sets(same.size());
  for (Eigen::Index t = 0; t < scene.triangles.rows(); ++t) {
    sets.join(vertex(t, 0), vertex(t, 1));
    sets.join(vertex(t, 0), vertex(t, 2));
  }
  std::vector<SceneObject> parts;
  std::unordered_map<std::size_t, std::size_t> part_of;
  for (Eigen::Index t = 0; t < scene.triangles.rows(); ++t) {
    const auto [found, is_new] = part_of.emplace(sets.of(vertex(t, 0)), parts.size());
    if (is_new) parts.emplace_back();
    hold_triangle(parts[found->second], scene, t);
  }
  return parts;
}

bool is_smaller_than_a_room(const SceneObject& part) {
  return (part.most_m - part.least_m).head<2>().maxCoeff() <= kRoom_m;
}

bool is_built_in(const SceneObject& part) {
  constexpr float kFlat_m = 0.03F;
  constexpr float kThin_m = 0.15F;
  constexpr float kDoor_m = 1.9F;
  const Eigen::Vector3f size_m = part.most_m - part.least_m;
  const bool covering = size_m.z() < kFlat_m && part.least_m.z() < kFlat_m;
  const bool door = size_m.head<2>().minCoeff() < kThin_m && size_m.z() > kDoor_m;
  return covering || door || !is_smaller_than_a_room(part);
}

bool touch(const SceneObject& a, const SceneObject& b) {
  return (a.least_m.array() < b.most_m.array() + kGap_m).all() && (b.least_m.array() < a.most_m.array() + kGap_m).all();
}

std::vector<SceneObject> objects_of_mesh(const Scene& scene) {
  std::vector<SceneObject> parts = components(scene);
  std::erase_if(parts, is_built_in);
  JoinedSets sets(parts.size());
  // Along x, so that far ones need not be asked.
  std::ranges::stable_sort(parts, {}, [](const SceneObject& part) { return part.least_m.x(); });
  for (std::size_t a = 0; a < parts.size(); ++a) {
    for (std::size_t b = a + 1; b < parts.size() && parts[b].least_m.x() < parts[a].most_m.x() + kGap_m; ++b) {
      if (touch(parts[a], parts[b])) sets.join(a, b);
    }
  }
  std::map<std::size_t, SceneObject> groups;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    SceneObject& group = groups[sets.of(i)];
    group.triangles.insert(group.triangles.end(), parts[i].triangles.begin(), parts[i].triangles.end());
    group.least_m = group.least_m.cwiseMin(parts[i].least_m);
    group.most_m = group.most_m.cwiseMax(parts[i].most_m);
  }
  std::vector<SceneObject> objects;
  for (auto& [first, group] : groups) {
    constexpr float kOnFloor_m = 0.15F;
    constexpr float kLeastHeight_m = 0.1F;
    if (group.least_m.z() > kOnFloor_m || group.most_m.z() < kLeastHeight_m || !is_smaller_than_a_room(group)) continue;
    std::ranges::sort(group.triangles);
    objects.push_back(std::move(group));
  }
  return objects;
}

}  // namespace

std::vector<SceneObject> objects_of(const World& world) {
  if (world.furniture.empty()) return objects_of_mesh(world.scene);
  std::vector<SceneObject> objects;
  for (const Furniture& piece : world.furniture) {
    SceneObject object;
    object.movable = piece.movable;
    for (Eigen::Index t = piece.first; t < piece.first + piece.count; ++t) hold_triangle(object, world.scene, t);
    objects.push_back(std::move(object));
  }
  return objects;
}

}  // namespace homeward::sim
