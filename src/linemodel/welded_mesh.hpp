// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "raycast/ray_scene.hpp"

namespace homeward::linemodel {

/// Points by the cell of space that they lie in: which of them are near another one.
class PointGrid {
 public:
  explicit PointGrid(float cell_m) : cell_m_(cell_m) {}
  void add(const Eigen::Vector3f& point_m, int index) { cells_[key_of(cell_of(point_m))].push_back(index); }
  /// Calls `visit(index)` for every point of the cells within a cell's width of `point_m`.
  template <class Visit>
  void visit_near(const Eigen::Vector3f& point_m, Visit visit) const {
    const Eigen::Array3i cell = cell_of(point_m);
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        for (int z = -1; z <= 1; ++z) {
          const auto found = cells_.find(key_of(cell + Eigen::Array3i(x, y, z)));
          if (found == cells_.end()) continue;
          for (const int index : found->second) visit(index);
        }
      }
    }
  }

 private:
  [[nodiscard]] Eigen::Array3i cell_of(const Eigen::Vector3f& point_m) const {
    return (point_m.array() / cell_m_).floor().cast<int>();
  }
  /// 21 bits of each coordinate: cells that far apart share a key, which costs time alone.
  static std::uint64_t key_of(const Eigen::Array3i& cell) {
    const auto bits = [](int value) {
      return static_cast<std::uint64_t>(static_cast<std::uint32_t>(value)) & 0x1FFFFF;
    };
    return bits(cell.x()) | bits(cell.y()) << 21 | bits(cell.z()) << 42;
  }

  float cell_m_;
  std::unordered_map<std::uint64_t, std::vector<int>> cells_;
};

/// Triangles whose corners are the same point where they lie together.
struct WeldedMesh {
  std::vector<Eigen::Vector3f> points_m;
  std::vector<std::array<int, 3>> triangles;  // each with three points of its own and an area
};

/// Welds corners that lie within `within_m` of one another, and leaves out triangles that then have no area.
WeldedMesh weld(const raycast::Vertices& vertices_m, const raycast::Triangles& triangles, float within_m);

}  // namespace homeward::linemodel
