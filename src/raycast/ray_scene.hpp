// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace homeward::raycast {

using Vertices = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;          // V x 3, metres
using Triangles = Eigen::Matrix<std::int32_t, Eigen::Dynamic, 3, Eigen::RowMajor>;  // T x 3, indices of vertices

/// Where a ray first meets the scene: the corners of the triangle weigh (1 - u - v, u, v).
struct Hit {
  static constexpr std::uint32_t kNoTriangle = 0xFFFFFFFFU;
  std::uint32_t triangle = 0;
  float u = 0.0F;
  float v = 0.0F;
  float distance_m = 0.0F;
};

/// Up to eight rays from one origin, for coherent casting. Only the first `count` are cast.
struct RayPacket {
  static constexpr std::size_t kMost = 8;
  alignas(32) std::array<float, kMost> x{};  // of the directions, unit vectors
  alignas(32) std::array<float, kMost> y{};
  alignas(32) std::array<float, kMost> z{};
  std::size_t count = kMost;

  [[nodiscard]] Eigen::Vector3f direction(std::size_t ray) const { return {x[ray], y[ray], z[ray]}; }
};

/// Triangles ready for ray casting (Embree). Thread-safe for casting.
class RayScene {
 public:
  /// `panes`: of each triangle, whether it is one of glass that some sensors see through; empty: none is.
  RayScene(const Vertices& vertices_m, const Triangles& triangles, std::vector<bool> panes = {});
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  [[nodiscard]] std::optional<Hit> first_hit(const Eigen::Vector3f& origin_m, const Eigen::Vector3f& direction,
                                             float far_m) const;
  /// The same of each ray of a packet; a ray that meets nothing has no triangle.
  [[nodiscard]] std::array<Hit, RayPacket::kMost> first_hits(const Eigen::Vector3f& origin_m, const RayPacket& packet,
                                                             float far_m) const;
  /// Whether anything lies between `from_m` and `to_m`.
  [[nodiscard]] bool blocked(const Eigen::Vector3f& from_m, const Eigen::Vector3f& to_m) const;
  /// Whether a triangle is a pane of glass.
  [[nodiscard]] bool is_pane(std::uint32_t triangle) const { return triangle < panes_.size() && panes_[triangle]; }

 private:
  struct Embree;

  void attach(const Vertices& vertices_m, const Triangles& triangles);

  std::unique_ptr<Embree> embree_;
  std::vector<bool> panes_;  // of each triangle
};

}  // namespace homeward::raycast
