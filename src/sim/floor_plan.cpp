// SPDX-License-Identifier: Apache-2.0
#include "sim/floor_plan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "sim/triangles.hpp"

namespace homeward::sim {
namespace {

constexpr double kTile_m = 0.25;

/// The part of a polygon on the upper (sign 1) or the lower side (sign -1) of a height.
std::vector<Eigen::Vector3d> cut(const std::vector<Eigen::Vector3d>& polygon, double height_m, double sign) {
  std::vector<Eigen::Vector3d> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector3d& from = polygon[i];
    const Eigen::Vector3d& to = polygon[(i + 1) % polygon.size()];
    const double from_m = sign * (from.z() - height_m);
    const double to_m = sign * (to.z() - height_m);
    if (from_m >= 0.0) kept.push_back(from);
    if ((from_m < 0.0) != (to_m < 0.0)) kept.emplace_back(from + from_m / (from_m - to_m) * (to - from));
  }
  return kept;
}

/// The least distance of an outline to a line segment in its frame. The distance to a convex outline is convex along
/// the segment, so that thirds of it can be ruled out in turn.
double nearest_on_m(const Outline& outline, const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m) {
  constexpr int kSteps = 28;  // of a tile's diagonal 4 micrometres are left
  double low = 0.0;
  double high = 1.0;
  const auto at = [&](double share) { return distance_m(outline, from_m + share * (to_m - from_m)); };
  for (int i = 0; i < kSteps; ++i) {
    const double left = low + (high - low) / 3.0;
    const double right = high - (high - low) / 3.0;
    (at(left) < at(right) ? high : low) = at(left) < at(right) ? right : left;
  }
  return std::min({at(0.0), at(1.0), at(0.5 * (low + high))});
}

}  // namespace

FloorPlan::FloorPlan(const Scene& scene, double lowest_m, double highest_m) {
  if (scene.vertices_m.rows() == 0) {
    tiles_.resize(1);
    return;
  }
  const auto [least_m, most_m] = floor_extent(scene);
  origin_m_ = least_m;
  columns_ = static_cast<int>((most_m.x() - least_m.x()) / kTile_m) + 1;
  rows_ = static_cast<int>((most_m.y() - least_m.y()) / kTile_m) + 1;
  tiles_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  for (Eigen::Index t = 0; t < scene.triangles.rows(); ++t) {
    const std::array<Eigen::Vector3d, 3> corners = corners_m(scene, t);
    std::vector<Eigen::Vector3d> polygon(corners.begin(), corners.end());
    polygon = cut(cut(polygon, lowest_m, 1.0), highest_m, -1.0);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      add_edge(polygon[i].head<2>(), polygon[(i + 1) % polygon.size()].head<2>());
    }
  }
  // What neighbouring triangles share, and what lies above each other, is needed once.
  const auto values = [](const Edge& edge) {
    return std::tuple(edge.from_m.x(), edge.from_m.y(), edge.to_m.x(), edge.to_m.y());
  };
  for (std::vector<Edge>& edges : tiles_) {
    std::ranges::sort(edges, {}, values);
    const auto same = [&](const Edge& a, const Edge& b) { return values(a) == values(b); };
    edges.erase(std::unique(edges.begin(), edges.end(), same), edges.end());
    edges.shrink_to_fit();
  }
}

void FloorPlan::add(const Box& box) {
  constexpr int kChords = 16;  // of a rounded corner; one of 0.35 m is then cut short by 0.5 mm at most
  const int chords = box.foot.radius_m > 0.0 ? kChords : 0;
  std::vector<Eigen::Vector2d> around_m;
  for (int corner = 0; corner < 4; ++corner) {
    const double x_m = corner == 0 || corner == 3 ? box.foot.front_m : -box.foot.back_m;
    const double y_m = corner < 2 ? box.foot.side_m : -box.foot.side_m;
    for (int i = 0; i <= chords; ++i) {
      const double angle_rad = 0.5 * std::numbers::pi * (corner + (chords > 0 ? static_cast<double>(i) / chords : 0.0));
      const Pose2 at = box.pose * Pose2{x_m + box.foot.radius_m * std::cos(angle_rad),
                                        y_m + box.foot.radius_m * std::sin(angle_rad), 0.0};
      around_m.emplace_back(at.x_m, at.y_m);
    }
  }
  for (std::size_t i = 0; i < around_m.size(); ++i) add_edge(around_m[i], around_m[(i + 1) % around_m.size()]);
}

void FloorPlan::add_edge(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m) {
  // One direction for both sides of an edge; pieces no longer than a tile, so that a long one lies in few.
  const bool turned = std::pair(to_m.x(), to_m.y()) < std::pair(from_m.x(), from_m.y());
  const Eigen::Vector2d& first_m = turned ? to_m : from_m;
  const Eigen::Vector2d along_m = (turned ? from_m : to_m) - first_m;
  const int pieces = std::max(1, static_cast<int>(std::ceil(along_m.norm() / kTile_m)));
  for (int i = 0; i < pieces; ++i) {
    const Eigen::Vector2d begin_m = first_m + along_m * i / pieces;
    const Eigen::Vector2d end_m = first_m + along_m * (i + 1) / pieces;
    const Edge edge{begin_m.cast<float>(), end_m.cast<float>()};
    for (int row = row_of(std::min(begin_m.y(), end_m.y())); row <= row_of(std::max(begin_m.y(), end_m.y())); ++row) {
      for (int column = column_of(begin_m.x()); column <= column_of(end_m.x()); ++column) {
        tile(column, row).push_back(edge);
      }
    }
  }
}

double FloorPlan::clearance_m(const Outline& outline, const Pose2& pose, double far_m) const {
  const Pose2 from_world = inverse(pose);
  const double c = std::cos(from_world.theta_rad);
  const double s = std::sin(from_world.theta_rad);
  const auto seen = [&](const Eigen::Vector2f& point_m) {
    const Eigen::Vector2d at_m = point_m.cast<double>();
    return Eigen::Vector2d(from_world.x_m + c * at_m.x() - s * at_m.y(), from_world.y_m + s * at_m.x() + c * at_m.y());
  };
  const double reach_m = swept_radius_m(outline) + std::max(0.0, far_m);
  double nearest_m = far_m;
  for (int row = row_of(pose.y_m - reach_m); row <= row_of(pose.y_m + reach_m); ++row) {
    for (int column = column_of(pose.x_m - reach_m); column <= column_of(pose.x_m + reach_m); ++column) {
      for (const Edge& edge : tile(column, row)) {
        const Eigen::Vector2d from_m = seen(edge.from_m);
        const Eigen::Vector2d to_m = seen(edge.to_m);
        // A distance changes by no more than the way.
        if (distance_m(outline, 0.5 * (from_m + to_m)) - 0.5 * (to_m - from_m).norm() >= nearest_m) continue;
        nearest_m = std::min(nearest_m, nearest_on_m(outline, from_m, to_m));
      }
    }
  }
  return nearest_m;
}

int FloorPlan::column_of(double x_m) const {
  return static_cast<int>(std::clamp((x_m - origin_m_.x()) / kTile_m, 0.0, static_cast<double>(columns_ - 1)));
}

int FloorPlan::row_of(double y_m) const {
  return static_cast<int>(std::clamp((y_m - origin_m_.y()) / kTile_m, 0.0, static_cast<double>(rows_ - 1)));
}

std::vector<FloorPlan::Edge>& FloorPlan::tile(int column, int row) {
  return tiles_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column)];
}

const std::vector<FloorPlan::Edge>& FloorPlan::tile(int column, int row) const {
  return tiles_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column)];
}

}  // namespace homeward::sim
