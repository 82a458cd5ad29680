// SPDX-License-Identifier: Apache-2.0
#include "linemodel/crossing_edges.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace homeward::linemodel {
namespace {

constexpr float kThrough_m = 0.002F;  // how far a surface has to reach to the other's far side

struct LargeTriangle {
  std::array<Eigen::Vector3f, 3> corners_m;
  Eigen::Vector3f normal;
  Eigen::AlignedBox3f box;
};

std::vector<LargeTriangle> large_triangles(const WeldedMesh& mesh) {
  constexpr float kLarge_m = 0.5F;
  std::vector<LargeTriangle> large;
  for (const auto& corners : mesh.triangles) {
    LargeTriangle triangle;
    float longest_m = 0.0F;
    for (std::size_t k = 0; k < 3; ++k) {
      triangle.corners_m[k] = mesh.points_m[static_cast<std::size_t>(corners[k])];
      triangle.box.extend(triangle.corners_m[k]);
    }
    const auto& [a, b, c] = triangle.corners_m;
    longest_m = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    if (longest_m < kLarge_m) continue;
    triangle.normal = (b - a).cross(c - a).normalized();
    large.push_back(triangle);
  }
  // Along x, so that far ones need not be asked.
  std::ranges::stable_sort(large, {}, [](const LargeTriangle& triangle) { return triangle.box.min().x(); });
  return large;
}

/// Where a triangle goes through the plane of another one: from and to along `axis`; nothing where it only touches.
std::optional<std::pair<float, float>> stretch_through(const LargeTriangle& triangle, const LargeTriangle& plane,
                                                       const Eigen::Vector3f& axis) {
  std::array<float, 3> off_m;
  std::array<float, 3> along_m;
  for (std::size_t k = 0; k < 3; ++k) {
    off_m[k] = plane.normal.dot(triangle.corners_m[k] - plane.corners_m[0]);
    along_m[k] = axis.dot(triangle.corners_m[k] - plane.corners_m[0]);
  }
  const auto [least, most] = std::ranges::minmax(off_m);
  if (least > -kThrough_m || most < kThrough_m) return std::nullopt;
  std::pair<float, float> stretch{1e9F, -1e9F};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    if ((off_m[k] < 0.0F) == (off_m[next] < 0.0F)) continue;
    const float share = off_m[k] / (off_m[k] - off_m[next]);
    const float at_m = along_m[k] + share * (along_m[next] - along_m[k]);
    stretch = {std::min(stretch.first, at_m), std::max(stretch.second, at_m)};
  }
  return stretch;
}

struct Crossing {
  Eigen::Vector3f from_m;
  Eigen::Vector3f to_m;
};

std::optional<Crossing> crossing_of(const LargeTriangle& a, const LargeTriangle& b, float least_sine) {
  constexpr float kLeast_m = 0.01F;
  const Eigen::Vector3f across = a.normal.cross(b.normal);
  if (across.norm() < least_sine) return std::nullopt;
  const Eigen::Vector3f axis = across.normalized();
  const auto of_a = stretch_through(a, b, axis);
  const auto of_b = of_a ? stretch_through(b, a, axis) : std::nullopt;
  if (!of_b) return std::nullopt;
  // Both along the axis, but from b's first corner and from a's.
  const float shift_m = axis.dot(a.corners_m[0] - b.corners_m[0]);
  const float from_m = std::max(of_a->first, of_b->first + shift_m);
  const float to_m = std::min(of_a->second, of_b->second + shift_m);
  if (to_m - from_m < kLeast_m) return std::nullopt;
  // A point of both planes: from b's corner within b's plane, at right angles to the axis, to a's plane.
  const Eigen::Vector3f within_b = axis.cross(b.normal);
  const float off_m = a.normal.dot(a.corners_m[0] - b.corners_m[0]);
  const Eigen::Vector3f on_both_m = b.corners_m[0] + within_b * (off_m / a.normal.dot(within_b));
  return Crossing{on_both_m + from_m * axis, on_both_m + to_m * axis};
}

/// Points of the mesh that were added, found again by where they are.
class AddedPoints {
 public:
  explicit AddedPoints(WeldedMesh& mesh) : mesh_(mesh), grid_(kSame_m) {}
  int index_of(const Eigen::Vector3f& point_m) {
    int found = -1;
    grid_.visit_near(point_m, [&](int index) {
      if (found < 0 && (mesh_.points_m[static_cast<std::size_t>(index)] - point_m).norm() < kSame_m) found = index;
    });
    if (found >= 0) return found;
    found = static_cast<int>(mesh_.points_m.size());
    mesh_.points_m.push_back(point_m);
    grid_.add(point_m, found);
    return found;
  }

 private:
  static constexpr float kSame_m = 0.002F;
  WeldedMesh& mesh_;
  PointGrid grid_;
};

}  // namespace

std::vector<RimEdge> crossing_edges(WeldedMesh& mesh, float crease_rad) {
  const std::vector<LargeTriangle> large = large_triangles(mesh);
  const float least_sine = std::sin(crease_rad);
  AddedPoints points(mesh);
  std::map<std::pair<int, int>, RimEdge> edges;  // two faces may lie on one another
  for (std::size_t i = 0; i < large.size(); ++i) {
    for (std::size_t j = i + 1; j < large.size() && large[j].box.min().x() <= large[i].box.max().x(); ++j) {
      if (!large[i].box.intersects(large[j].box)) continue;
      const auto crossing = crossing_of(large[i], large[j], least_sine);
      if (!crossing) continue;
      const auto [from, to] = std::minmax({points.index_of(crossing->from_m), points.index_of(crossing->to_m)});
      if (from == to) continue;
      const Eigen::Vector3f axis = (crossing->to_m - crossing->from_m).normalized();
      const Eigen::Vector3f along_i = axis.cross(large[i].normal).normalized();
      const Eigen::Vector3f along_j = axis.cross(large[j].normal).normalized();
      edges.try_emplace({from, to}, RimEdge{from, to, {along_i, -along_i, along_j, -along_j}});
    }
  }
  std::vector<RimEdge> list;
  list.reserve(edges.size());
  for (auto& [ends, edge] : edges) list.push_back(std::move(edge));
  return list;
}

}  // namespace homeward::linemodel
