// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "raycast/ray_scene.hpp"

namespace homeward::linemodel {

/// A mesh put together from loose quads and boxes, as simulated worlds are.
class MeshOfBoxes {
 public:
  void quad(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c, const Eigen::Vector3f& d) {
    for (const Eigen::Vector3f& corner : {a, b, c, a, c, d}) corners_.push_back(corner);
  }
  void box(const Eigen::Vector3f& least, const Eigen::Vector3f& most) {
    const auto corner = [&](int number) {
      return Eigen::Vector3f(number & 1 ? most.x() : least.x(), number & 2 ? most.y() : least.y(),
                             number & 4 ? most.z() : least.z());
    };
    constexpr std::array<std::array<int, 4>, 6> kFaces = {
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    for (const auto& [a, b, c, d] : kFaces) quad(corner(a), corner(b), corner(c), corner(d));
  }
  [[nodiscard]] raycast::Vertices vertices_m() const {
    raycast::Vertices vertices(static_cast<Eigen::Index>(corners_.size()), 3);
    for (std::size_t i = 0; i < corners_.size(); ++i)
      vertices.row(static_cast<Eigen::Index>(i)) = corners_[i].transpose();
    return vertices;
  }
  [[nodiscard]] raycast::Triangles triangles() const {
    raycast::Triangles triangles(static_cast<Eigen::Index>(corners_.size() / 3), 3);
    for (Eigen::Index i = 0; i < triangles.size(); ++i) triangles(i / 3, i % 3) = static_cast<std::int32_t>(i);
    return triangles;
  }

 private:
  std::vector<Eigen::Vector3f> corners_;
};

}  // namespace homeward::linemodel
