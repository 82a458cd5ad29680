// SPDX-License-Identifier: Apache-2.0
#include "linemodel/polygon.hpp"

#include <Eigen/Geometry>
#include <numeric>

namespace homeward::linemodel {
namespace {

/// Newell's normal: twice the area, along the side from which the corners go counter-clockwise.
Eigen::Vector3d newell_normal(std::span<const Eigen::Vector3d> corners) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3d a = corners[i] - corners[0];
    const Eigen::Vector3d b = corners[(i + 1) % corners.size()] - corners[0];
    normal += a.cross(b);
  }
  return normal;
}

double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// The polygon in its own plane, counter-clockwise.
std::vector<Eigen::Vector2d> in_plane(std::span<const Eigen::Vector3d> corners, const Eigen::Vector3d& normal) {
  const Eigen::Vector3d w = normal.normalized();
  const Eigen::Vector3d u = w.unitOrthogonal();
  const Eigen::Vector3d v = w.cross(u);
  std::vector<Eigen::Vector2d> flat;
  flat.reserve(corners.size());
  for (const Eigen::Vector3d& corner : corners)
    flat.emplace_back(u.dot(corner - corners[0]), v.dot(corner - corners[0]));
  return flat;
}

bool is_convex(const std::vector<Eigen::Vector2d>& flat) {
  // Only left turns, and once round: a star turns left too.
  const std::size_t n = flat.size();
  double round_rad = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d along = flat[(i + 1) % n] - flat[i];
    const Eigen::Vector2d next = flat[(i + 2) % n] - flat[(i + 1) % n];
    const double cross = along.x() * next.y() - along.y() * next.x();
    if (cross < -1e-9 * along.norm() * next.norm()) return false;
    round_rad += std::atan2(cross, along.dot(next));
  }
  return round_rad < 7.0;
}

bool is_ear(const std::vector<Eigen::Vector2d>& flat, const std::vector<std::size_t>& left, std::size_t at) {
  const std::size_t n = left.size();
  const std::size_t before = left[(at + n - 1) % n];
  const std::size_t after = left[(at + 1) % n];
  const Eigen::Vector2d& a = flat[before];
  const Eigen::Vector2d& b = flat[left[at]];
  const Eigen::Vector2d& c = flat[after];
  if (turn(a, b, c) <= 0.0) return false;
  for (const std::size_t other : left) {
    const Eigen::Vector2d& p = flat[other];
    if (p == a || p == b || p == c) continue;
    if (turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0) return false;
  }
  return true;
}

}  // namespace

std::optional<std::vector<std::array<std::size_t, 3>>> triangles_of_polygon(std::span<const Eigen::Vector3d> corners) {
  std::vector<std::array<std::size_t, 3>> triangles;
  if (corners.size() < 3) return triangles;
  const Eigen::Vector3d normal = newell_normal(corners);
  if (!(normal.norm() > 0.0) || !normal.allFinite()) return triangles;
  const std::vector<Eigen::Vector2d> flat = in_plane(corners, normal);
  if (corners.size() == 3 || is_convex(flat)) {
    for (std::size_t i = 2; i < corners.size(); ++i) triangles.push_back({0, i - 1, i});
    return triangles;
  }
  if (corners.size() > kMostCornersOfConcave) return std::nullopt;
  std::vector<std::size_t> left(corners.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  while (left.size() >= 3) {
    std::size_t at = 0;
    while (at < left.size() && !is_ear(flat, left, at)) ++at;
    // Only a rim that touches or crosses itself has no ear: any corner will do then.
    if (at == left.size()) at = 0;
    const std::size_t n = left.size();
    triangles.push_back({left[(at + n - 1) % n], left[at], left[(at + 1) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
  }
  return triangles;
}

}  // namespace homeward::linemodel
