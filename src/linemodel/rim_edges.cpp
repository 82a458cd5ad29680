// SPDX-License-Identifier: Apache-2.0
#include "linemodel/rim_edges.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace homeward::linemodel {
namespace {

constexpr float kSameFace = 0.9986F;  // cosine of 3 degrees

Eigen::Vector3f across(const Eigen::Vector3f& axis, const Eigen::Vector3f& towards) {
  return (towards - axis * axis.dot(towards)).normalized();
}

void add_face(RimEdge& edge, const Eigen::Vector3f& face) {
  for (const Eigen::Vector3f& known : edge.faces) {
    if (known.dot(face) > kSameFace) return;
  }
  edge.faces.push_back(face);
}

/// Puts edges between the same points together. What is left out: two surfaces that go on as one.
std::vector<RimEdge> merged(std::vector<RimEdge> edges, float crease_rad) {
  std::ranges::stable_sort(
      edges, [](const RimEdge& a, const RimEdge& b) { return std::pair(a.from, a.to) < std::pair(b.from, b.to); });
  const float straight = -std::cos(crease_rad);
  std::vector<RimEdge> result;
  const auto drop_if_smooth = [&] {
    if (!result.empty() && result.back().faces.size() == 2 &&
        result.back().faces[0].dot(result.back().faces[1]) < straight)
      result.pop_back();
  };
  for (RimEdge& edge : edges) {
    if (!result.empty() && result.back().from == edge.from && result.back().to == edge.to) {
      for (const Eigen::Vector3f& face : edge.faces) add_face(result.back(), face);
      continue;
    }
    drop_if_smooth();
    result.push_back(std::move(edge));
  }
  drop_if_smooth();
  return result;
}

std::vector<RimEdge> triangle_edges(const WeldedMesh& mesh) {
  std::vector<RimEdge> edges;
  edges.reserve(3 * mesh.triangles.size());
  const auto point = [&](int index) { return mesh.points_m[static_cast<std::size_t>(index)]; };
  for (const auto& corners : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int from = std::min(corners[k], corners[(k + 1) % 3]);
      const int to = std::max(corners[k], corners[(k + 1) % 3]);
      const Eigen::Vector3f axis = (point(to) - point(from)).normalized();
      edges.push_back({from, to, {across(axis, point(corners[(k + 2) % 3]) - point(from))}});
    }
  }
  return edges;
}

/// Edges cut at the ends of others that lie on them.
std::vector<RimEdge> cut_at_points(const WeldedMesh& mesh, const std::vector<RimEdge>& edges) {
  constexpr float kCell_m = 0.2F;
  constexpr float kOn_m = 0.002F;
  const auto point = [&](int index) { return mesh.points_m[static_cast<std::size_t>(index)]; };
  std::vector<bool> is_in(mesh.points_m.size(), false);
  PointGrid grid(kCell_m);
  for (const RimEdge& edge : edges) {
    for (const int end : {edge.from, edge.to}) {
      if (!is_in[static_cast<std::size_t>(end)]) grid.add(point(end), end);
      is_in[static_cast<std::size_t>(end)] = true;
    }
  }
  std::vector<RimEdge> pieces;
  std::vector<std::pair<float, int>> cuts;
  for (const RimEdge& edge : edges) {
    const Eigen::Vector3f way_m = point(edge.to) - point(edge.from);
    const float length_m = way_m.norm();
    const Eigen::Vector3f axis = way_m / length_m;
    cuts = {{0.0F, edge.from}, {length_m, edge.to}};
    const int steps = static_cast<int>(length_m / kCell_m);
    for (int step = 0; step <= steps; ++step) {
      grid.visit_near(point(edge.from) + (static_cast<float>(step) + 0.5F) * kCell_m * axis, [&](int index) {
        const Eigen::Vector3f off_m = point(index) - point(edge.from);
        const float along_m = axis.dot(off_m);
        if (along_m > kOn_m && along_m < length_m - kOn_m && (off_m - along_m * axis).norm() < kOn_m)
          cuts.emplace_back(along_m, index);
      });
    }
    std::ranges::sort(cuts);
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
    for (std::size_t i = 1; i < cuts.size(); ++i) {
      const auto [from, to] = std::minmax(cuts[i - 1].second, cuts[i].second);
      const Eigen::Vector3f piece_axis = (point(to) - point(from)).normalized();
      RimEdge piece{from, to, {}};
      for (const Eigen::Vector3f& face : edge.faces) add_face(piece, across(piece_axis, face));
      pieces.push_back(std::move(piece));
    }
  }
  return pieces;
}

}  // namespace

std::vector<RimEdge> rim_edges(const WeldedMesh& mesh, float crease_rad) {
  return merged(cut_at_points(mesh, merged(triangle_edges(mesh), crease_rad)), crease_rad);
}

}  // namespace homeward::linemodel
