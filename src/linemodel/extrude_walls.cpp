// SPDX-License-Identifier: Apache-2.0
#include "linemodel/extrude_walls.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include "linemodel/plan_builder.hpp"

namespace homeward::linemodel {
namespace {

/// Corners of walls by where they are; one that lies near another is that one.
class WallCorners {
 public:
  std::size_t find_or_add(const Eigen::Vector2d& point_m) {
    const Cell cell = {std::llround(std::floor(point_m.x() / kSame_m)),
                       std::llround(std::floor(point_m.y() / kSame_m))};
    for (std::int64_t x = -1; x <= 1; ++x) {
      for (std::int64_t y = -1; y <= 1; ++y) {
        const auto found = first_of_.find({cell.first + x, cell.second + y});
        if (found != first_of_.end() && (points_m_[found->second] - point_m).norm() <= kSame_m) return found->second;
      }
    }
    first_of_.emplace(cell, points_m_.size());
    points_m_.push_back(point_m);
    return points_m_.size() - 1;
  }
  [[nodiscard]] const std::vector<Eigen::Vector2d>& points_m() const { return points_m_; }

 private:
  static constexpr double kSame_m = 0.005;
  using Cell = std::pair<std::int64_t, std::int64_t>;
  std::map<Cell, std::size_t> first_of_;
  std::vector<Eigen::Vector2d> points_m_;
};

/// Whether the walls that leave a corner into these directions are one that goes straight on.
bool goes_on(const std::vector<Eigen::Vector2d>& directions) {
  constexpr double kStraight = -0.9994;  // cosine of 2 degrees, backwards
  return directions.size() == 2 && directions[0].dot(directions[1]) < kStraight;
}

Eigen::Vector3d at_height(const Eigen::Vector2d& point_m, double height_m) {
  return {point_m.x(), point_m.y(), height_m};
}

}  // namespace

Result<Plan> extrude_walls(const std::vector<Wall>& walls, double height_m, const std::string& where) {
  if (!(height_m >= 0.1 && height_m <= 100.0))
    return fail(ErrorCode::kInvalidInput, "Walls are between 0.1 m and 100 m high.", where);
  WallCorners corners;
  std::set<std::pair<std::size_t, std::size_t>> stood_up;
  std::map<std::size_t, std::vector<Eigen::Vector2d>> directions;
  PlanBuilder builder;
  for (const Wall& wall : walls) {
    for (const Eigen::Vector2d& end_m : {wall.from_m, wall.to_m}) {
      if (!(end_m.array().abs() <= kFarthest_m).all()) {
        return fail(ErrorCode::kInvalidInput,
                    "A wall lies more than 10 km from the origin. The scale (metres a unit) may be wrong.", where);
      }
    }
    const auto [a, b] = std::minmax({corners.find_or_add(wall.from_m), corners.find_or_add(wall.to_m)});
    if (a == b || !stood_up.emplace(a, b).second) continue;
    const Eigen::Vector2d from_m = corners.points_m()[a];
    const Eigen::Vector2d to_m = corners.points_m()[b];
    directions[a].push_back((to_m - from_m).normalized());
    directions[b].push_back((from_m - to_m).normalized());
    for (const double z_m : {0.0, height_m}) {
      if (const Status added = builder.add_line(at_height(from_m, z_m), at_height(to_m, z_m), where); !added)
        return pass_on(added);
    }
    const std::array<Eigen::Vector3d, 4> rim = {at_height(from_m, 0.0), at_height(to_m, 0.0), at_height(to_m, height_m),
                                                at_height(from_m, height_m)};
    for (const std::size_t k : {std::size_t{1}, std::size_t{2}}) {
      if (const Status added = builder.add_triangle({rim[0], rim[k], rim[k + 1]}, where); !added) return pass_on(added);
    }
  }
  if (stood_up.empty()) return fail(ErrorCode::kEmptyInput, "The floor plan has no straight line.", where);
  for (const auto& [corner, leaving] : directions) {
    if (goes_on(leaving)) continue;
    const Eigen::Vector2d& at_m = corners.points_m()[corner];
    if (const Status added = builder.add_line(at_height(at_m, 0.0), at_height(at_m, height_m), where); !added)
      return pass_on(added);
  }
  return builder.take(where);
}

}  // namespace homeward::linemodel
