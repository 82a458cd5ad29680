// SPDX-License-Identifier: Apache-2.0
#include "driving/local_path.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <vector>

namespace homeward::driving {
namespace {

constexpr double kCell_m = 0.06;
constexpr int kHalfCells = 50;  // 3 m to each side
constexpr int kSide = 2 * kHalfCells + 1;
constexpr double kSpare_m = 0.07;    // beside the body's own radius, more than the safety margin
constexpr double kComfort_m = 0.35;  // beyond that nothing costs extra
constexpr double kCarrot_m = 0.55;

struct Cell {
  int x = 0;
  int y = 0;
};

std::size_t slot(Cell cell) { return static_cast<std::size_t>(cell.y) * kSide + static_cast<std::size_t>(cell.x); }

Cell cell_of(const Eigen::Vector2d& point_m) {
  return {static_cast<int>(std::lround(point_m.x() / kCell_m)) + kHalfCells,
          static_cast<int>(std::lround(point_m.y() / kCell_m)) + kHalfCells};
}

Eigen::Vector2d centre_of(Cell cell) { return {(cell.x - kHalfCells) * kCell_m, (cell.y - kHalfCells) * kCell_m}; }

bool inside(Cell cell) { return cell.x >= 0 && cell.y >= 0 && cell.x < kSide && cell.y < kSide; }

/// Distance of each cell to the nearest point, up to `far_m`.
std::vector<float> distances(std::span<const Eigen::Vector2d> points_m, double far_m) {
  std::vector<float> distance(static_cast<std::size_t>(kSide) * kSide, static_cast<float>(far_m));
  const int reach = static_cast<int>(std::ceil(far_m / kCell_m));
  for (const Eigen::Vector2d& point : points_m) {
    const Cell middle = cell_of(point);
    for (int dy = -reach; dy <= reach; ++dy) {
      for (int dx = -reach; dx <= reach; ++dx) {
        const Cell cell{middle.x + dx, middle.y + dy};
        if (!inside(cell)) continue;
        float& value = distance[slot(cell)];
        value = std::min(value, static_cast<float>((centre_of(cell) - point).norm()));
      }
    }
  }
  return distance;
}

/// The points along the grid's axes. Sweeps hit a wall with many points in one cell; one of them is enough.
std::vector<Eigen::Vector2d> thinned(std::span<const Eigen::Vector2d> points_m, const Eigen::Rotation2Dd& from_robot) {
  std::vector<std::uint8_t> taken(static_cast<std::size_t>(kSide) * kSide, 0);
  std::vector<Eigen::Vector2d> result;
  for (const Eigen::Vector2d& seen : points_m) {
    const Eigen::Vector2d point = from_robot * seen;
    const Cell cell = cell_of(point);
    if (!inside(cell) || taken[slot(cell)] != 0) continue;
    taken[slot(cell)] = 1;
    result.push_back(point);
  }
  return result;
}

/// From a straight stretch, beginning at the robot, to the nearest point.
double clear_along_m(std::span<const Eigen::Vector2d> points_m, const Eigen::Vector2d& end_m) {
  const double length_squared = std::max(1e-12, end_m.squaredNorm());
  double nearest_m = 100.0;
  for (const Eigen::Vector2d& point : points_m) {
    const double share = std::clamp(point.dot(end_m) / length_squared, 0.0, 1.0);
    nearest_m = std::min(nearest_m, (point - share * end_m).norm());
  }
  return nearest_m;
}

/// The farthest point of the way, up to the carrot's distance, to which the straight line has room: heading for one
/// beyond a corner would cut it, and beside things the robot would be stopped again and again by its own caution.
Eigen::Vector2d carrot_on(std::span<const Eigen::Vector2d> way_m, std::span<const Eigen::Vector2d> points_m,
                          double blocked_m) {
  constexpr double kTolerance_m = 0.02;  // a step between two cells of the way grazes what neither of them does
  const double room_m = std::min(blocked_m, clear_along_m(points_m, Eigen::Vector2d::Zero())) - kTolerance_m;
  std::size_t end = 1;
  double length_m = (way_m[1] - way_m[0]).norm();
  while (end + 1 < way_m.size() && length_m < kCarrot_m) {
    ++end;
    length_m += (way_m[end] - way_m[end - 1]).norm();
  }
  while (end > 1 && clear_along_m(points_m, way_m[end]) < room_m) --end;
  return way_m[end];
}

/// What a search has found out about each cell.
struct Searched {
  std::vector<float> cost;
  std::vector<int> before;   // the cell through which it is reached; -1: none
  std::vector<bool> closed;  // its cheapest way is known
};

/// Dijkstra from the robot's cell until that of the goal is reached, or all are that can be.
Searched search(const std::vector<float>& distance, std::size_t goal_slot, double blocked_m) {
  constexpr double kCrowding = 2.5;  // a metre right beside things costs so many more
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const std::size_t start_slot = slot({kHalfCells, kHalfCells});
  Searched found{std::vector<float>(distance.size(), kInfinity), std::vector<int>(distance.size(), -1),
                 std::vector<bool>(distance.size(), false)};
  using Entry = std::pair<float, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  found.cost[start_slot] = 0.0F;
  open.emplace(0.0F, static_cast<int>(start_slot));
  const auto start_clear = static_cast<double>(distance[start_slot]);
  while (!open.empty()) {
    const auto index = static_cast<std::size_t>(open.top().second);
    open.pop();
    if (found.closed[index]) continue;
    found.closed[index] = true;
    if (index == goal_slot) break;
    const Cell cell{static_cast<int>(index % kSide), static_cast<int>(index / kSide)};
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const Cell next{cell.x + dx, cell.y + dy};
        if ((dx == 0 && dy == 0) || !inside(next)) continue;
        const auto clear_m = static_cast<double>(distance[slot(next)]);
        // Standing too close already, the robot may still move to where there is more room.
        if (clear_m < blocked_m && !(start_clear < blocked_m && clear_m >= static_cast<double>(distance[index])))
          continue;
        const double crowding = std::max(0.0, 1.0 - (clear_m - blocked_m) / kComfort_m);
        const auto step = static_cast<float>(kCell_m * std::sqrt(dx * dx + dy * dy) * (1.0 + kCrowding * crowding));
        if (found.cost[index] + step >= found.cost[slot(next)]) continue;
        found.cost[slot(next)] = found.cost[index] + step;
        found.before[slot(next)] = static_cast<int>(index);
        open.emplace(found.cost[slot(next)], static_cast<int>(slot(next)));
      }
    }
  }
  return found;
}

/// The cell nearest to a goal that cannot be reached; nothing where that is the robot's own.
std::optional<std::size_t> nearest_reached(const Searched& found, const Eigen::Vector2d& goal) {
  constexpr double kOfWay = 0.05;  // of cells about as near the one that costs less
  const Cell start{kHalfCells, kHalfCells};
  double best = (goal - centre_of(start)).norm();
  std::size_t last = slot(start);
  for (std::size_t i = 0; i < found.closed.size(); ++i) {
    if (!found.closed[i]) continue;
    const double apart_m = (centre_of({static_cast<int>(i % kSide), static_cast<int>(i / kSide)}) - goal).norm();
    if (apart_m + kOfWay * static_cast<double>(found.cost[i]) < best) {
      best = apart_m + kOfWay * static_cast<double>(found.cost[i]);
      last = i;
    }
  }
  if (last == slot(start)) return std::nullopt;
  return last;
}

/// The way to a cell, from the robot's own.
std::vector<Eigen::Vector2d> way_to(std::size_t last, const Searched& found) {
  std::vector<Eigen::Vector2d> way_m;
  for (int i = static_cast<int>(last); i >= 0; i = found.before[static_cast<std::size_t>(i)]) {
    way_m.push_back(centre_of({i % kSide, i / kSide}));
  }
  std::reverse(way_m.begin(), way_m.end());
  return way_m;
}

}  // namespace

std::optional<LocalWay> local_way(const Body& body, std::span<const Eigen::Vector2d> points_m,
                                  const Eigen::Vector2d& goal_m, double heading_rad) {
  // The grid keeps its axes while the robot turns: what is free must not change by turning, or it would dither.
  const Eigen::Rotation2Dd from_robot(heading_rad);
  const double blocked_m = body.outline.radius_m + kSpare_m;
  const std::vector<Eigen::Vector2d> near = thinned(points_m, from_robot);
  // A goal outside the grid is drawn to its border.
  Eigen::Vector2d goal = from_robot * goal_m;
  const double limit_m = (kHalfCells - 1) * kCell_m;
  const double largest_m = goal.cwiseAbs().maxCoeff();
  if (largest_m > limit_m) goal *= limit_m / largest_m;
  const std::size_t goal_slot = slot(cell_of(goal));
  const Searched found = search(distances(near, blocked_m + kComfort_m), goal_slot, blocked_m);
  LocalWay way;
  way.reaches_goal = found.closed[goal_slot];
  const auto last = way.reaches_goal ? std::optional(goal_slot) : nearest_reached(found, goal);
  if (!last) return std::nullopt;
  const std::vector<Eigen::Vector2d> points = way_to(*last, found);
  for (std::size_t i = 1; i < points.size(); ++i) way.length_m += (points[i] - points[i - 1]).norm();
  way.carrot_m = from_robot.inverse() * (points.size() > 1 ? carrot_on(points, near, blocked_m) : goal);
  return way;
}

}  // namespace homeward::driving
