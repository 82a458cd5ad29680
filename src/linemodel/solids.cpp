// SPDX-License-Identifier: Apache-2.0
#include "linemodel/solids.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace homeward::linemodel {
namespace {

class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  int of(int element) {
    auto& parent = parent_[static_cast<std::size_t>(element)];
    while (parent != parent_[static_cast<std::size_t>(parent)]) parent = parent_[static_cast<std::size_t>(parent)];
    return parent;
  }
  void join(int a, int b) { parent_[static_cast<std::size_t>(of(a))] = of(b); }

 private:
  std::vector<int> parent_;
};

struct Body {
  Eigen::Vector3f least_m = Eigen::Vector3f::Constant(1e9F);
  Eigen::Vector3f most_m = Eigen::Vector3f::Constant(-1e9F);
  double volume_m3 = 0.0;  // six times; above zero with the fronts outside
  bool closed = true;
};

}  // namespace

std::vector<bool> skins_of_solids(const WeldedMesh& mesh) {
  constexpr float kWidestSolid_m = 2.5F;
  Sets sets(mesh.points_m.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    sets.join(a, b);
    sets.join(b, c);
  }
  std::vector<Body> bodies(mesh.points_m.size());  // by the set's element
  const auto point = [&](int index) { return mesh.points_m[static_cast<std::size_t>(index)]; };
  std::vector<std::tuple<int, int, int>> edges;  // the lesser point, the greater one, and which way: 1 or -1
  edges.reserve(3 * mesh.triangles.size());
  for (const auto& corners : mesh.triangles) {
    Body& body = bodies[static_cast<std::size_t>(sets.of(corners[0]))];
    const Eigen::Vector3d about_m = point(sets.of(corners[0])).cast<double>();
    const auto off_m = [&](std::size_t k) { return Eigen::Vector3d(point(corners[k]).cast<double>() - about_m); };
    body.volume_m3 += off_m(0).dot(off_m(1).cross(off_m(2)));
    for (std::size_t k = 0; k < 3; ++k) {
      body.least_m = body.least_m.cwiseMin(point(corners[k]));
      body.most_m = body.most_m.cwiseMax(point(corners[k]));
      const int from = corners[k];
      const int to = corners[(k + 1) % 3];
      edges.emplace_back(std::min(from, to), std::max(from, to), from < to ? 1 : -1);
    }
  }
  std::ranges::sort(edges);
  for (std::size_t i = 0; i < edges.size();) {
    const auto [from, to, first_way] = edges[i];
    int balance = 0;
    for (; i < edges.size() && std::get<0>(edges[i]) == from && std::get<1>(edges[i]) == to; ++i)
      balance += std::get<2>(edges[i]);
    if (balance != 0) bodies[static_cast<std::size_t>(sets.of(from))].closed = false;
  }
  std::vector<bool> skins;
  skins.reserve(mesh.triangles.size());
  for (const auto& corners : mesh.triangles) {
    const Body& body = bodies[static_cast<std::size_t>(sets.of(corners[0]))];
    const Eigen::Vector3f size_m = body.most_m - body.least_m;
    skins.push_back(body.closed && body.volume_m3 > 0.0 && std::min(size_m.x(), size_m.y()) <= kWidestSolid_m);
  }
  return skins;
}

}  // namespace homeward::linemodel
