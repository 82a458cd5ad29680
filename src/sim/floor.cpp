// SPDX-License-Identifier: Apache-2.0
#include "sim/floor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "sim/triangles.hpp"

namespace homeward::sim {
namespace {

bool inside(const FloorGrid& grid, const Eigen::Vector2i& cell) {
  return cell.x() >= 0 && cell.y() >= 0 && cell.x() < grid.width && cell.y() < grid.height;
}

std::size_t slot(const FloorGrid& grid, const Eigen::Vector2i& cell) {
  return static_cast<std::size_t>(cell.y()) * static_cast<std::size_t>(grid.width) + static_cast<std::size_t>(cell.x());
}

Eigen::Vector2i nearest_set(const FloorGrid& grid, const Eigen::Vector2i& wanted) {
  Eigen::Vector2i best(-1, -1);
  int best2 = std::numeric_limits<int>::max();
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      const Eigen::Vector2i cell(column, row);
      if (grid.cells[slot(grid, cell)] == 0) continue;
      const int distance2 = (cell - wanted).squaredNorm();
      if (distance2 < best2) {
        best2 = distance2;
        best = cell;
      }
    }
  }
  return best;
}

/// One-dimensional squared distance transform (Felzenszwalb & Huttenlocher 2012), in place.
void transform_line(std::vector<float>& f) {
  const auto n = static_cast<int>(f.size());
  std::vector<int> v(f.size());
  std::vector<float> z(f.size() + 1);
  int k = 0;
  v[0] = 0;
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  z[0] = -kInfinity;
  z[1] = kInfinity;
  const auto at = [&](int i) { return f[static_cast<std::size_t>(i)]; };
  for (int q = 1; q < n; ++q) {
    const auto meet = [&](int p) {
      return ((at(q) + static_cast<float>(q * q)) - (at(p) + static_cast<float>(p * p))) /
             static_cast<float>(2 * (q - p));
    };
    float s = meet(v[static_cast<std::size_t>(k)]);
    while (k > 0 && s <= z[static_cast<std::size_t>(k)]) {
      --k;
      s = meet(v[static_cast<std::size_t>(k)]);
    }
    if (s <= z[static_cast<std::size_t>(k)]) s = z[static_cast<std::size_t>(k)];
    ++k;
    v[static_cast<std::size_t>(k)] = q;
    z[static_cast<std::size_t>(k)] = s;
    z[static_cast<std::size_t>(k) + 1] = kInfinity;
  }
  std::vector<float> result(f.size());
  k = 0;
  for (int q = 0; q < n; ++q) {
    while (z[static_cast<std::size_t>(k) + 1] < static_cast<float>(q)) ++k;
    const int p = v[static_cast<std::size_t>(k)];
    result[static_cast<std::size_t>(q)] = static_cast<float>((q - p) * (q - p)) + at(p);
  }
  f = std::move(result);
}

}  // namespace

Eigen::Vector2i cell_of(const FloorGrid& grid, const Eigen::Vector2d& point_m) {
  const Eigen::Vector2d from_corner = (point_m - grid.origin_m) / grid.resolution_m;
  return {static_cast<int>(std::floor(from_corner.x())),
          grid.height - 1 - static_cast<int>(std::floor(from_corner.y()))};
}

Eigen::Vector2d centre_of(const FloorGrid& grid, const Eigen::Vector2i& cell) {
  return grid.origin_m + grid.resolution_m * Eigen::Vector2d(cell.x() + 0.5, grid.height - 1 - cell.y() + 0.5);
}

bool is_set(const FloorGrid& grid, const Eigen::Vector2d& point_m) {
  const Eigen::Vector2i cell = cell_of(grid, point_m);
  return inside(grid, cell) && grid.cells[slot(grid, cell)] != 0;
}

FloorGrid occupied_cells(const Scene& scene, double resolution_m, double lowest_m, double highest_m) {
  constexpr double kMargin_m = 0.5;
  FloorGrid grid;
  grid.resolution_m = resolution_m;
  const auto [least_m, most_m] = floor_extent(scene);
  grid.origin_m = least_m.array() - kMargin_m;
  grid.width = static_cast<int>(std::ceil((most_m.x() - least_m.x() + 2.0 * kMargin_m) / resolution_m));
  grid.height = static_cast<int>(std::ceil((most_m.y() - least_m.y() + 2.0 * kMargin_m) / resolution_m));
  grid.cells.assign(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height), 0);
  mark_triangles(grid, scene, 0, scene.triangles.rows(), lowest_m, highest_m);
  return grid;
}

void mark_triangles(FloorGrid& grid, const Scene& scene, Eigen::Index first, Eigen::Index count, double lowest_m,
                    double highest_m) {
  // Points on every triangle, closer than half a cell, mark their cells.
  const double step_m = 0.45 * grid.resolution_m;
  for (Eigen::Index t = first; t < first + count; ++t) {
    const auto [a, b, c] = corners_m(scene, t);
    if (std::max({a.z(), b.z(), c.z()}) < lowest_m || std::min({a.z(), b.z(), c.z()}) > highest_m) continue;
    const int along_ab = std::max(1, static_cast<int>(std::ceil((b - a).norm() / step_m)));
    const int along_ac = std::max(1, static_cast<int>(std::ceil((c - a).norm() / step_m)));
    for (int i = 0; i <= along_ab; ++i) {
      for (int j = 0; j <= along_ac; ++j) {
        const double u = static_cast<double>(i) / along_ab;
        const double v = static_cast<double>(j) / along_ac;
        if (u + v > 1.0 + 1e-9) break;
        const Eigen::Vector3d point_m = a + u * (b - a) + v * (c - a);
        if (point_m.z() < lowest_m || point_m.z() > highest_m) continue;
        const Eigen::Vector2i cell = cell_of(grid, point_m.head<2>());
        if (inside(grid, cell)) grid.cells[slot(grid, cell)] = 255;
      }
    }
  }
}

std::vector<float> clearance(const FloorGrid& occupied) {
  const auto width = static_cast<std::size_t>(occupied.width);
  const auto height = static_cast<std::size_t>(occupied.height);
  constexpr float kFar = 1e12F;
  std::vector<float> squares(width * height);
  for (std::size_t i = 0; i < squares.size(); ++i) squares[i] = occupied.cells[i] != 0 ? 0.0F : kFar;
  std::vector<float> line(height);
  for (std::size_t u = 0; u < width; ++u) {
    line.resize(height);
    for (std::size_t v = 0; v < height; ++v) line[v] = squares[v * width + u];
    transform_line(line);
    for (std::size_t v = 0; v < height; ++v) squares[v * width + u] = line[v];
  }
  line.resize(width);
  for (std::size_t v = 0; v < height; ++v) {
    std::copy_n(squares.begin() + static_cast<std::ptrdiff_t>(v * width), width, line.begin());
    transform_line(line);
    std::copy(line.begin(), line.end(), squares.begin() + static_cast<std::ptrdiff_t>(v * width));
  }
  for (float& value : squares) value = std::sqrt(value) * static_cast<float>(occupied.resolution_m);
  return squares;
}

FloorGrid drivable_cells(const FloorGrid& occupied, double robot_radius_m, const Pose2& start) {
  const std::vector<float> clear_m = clearance(occupied);
  FloorGrid drivable = occupied;
  drivable.robot_radius_m = robot_radius_m;
  std::fill(drivable.cells.begin(), drivable.cells.end(), std::uint8_t{0});
  const auto free = [&](const Eigen::Vector2i& cell) {
    return static_cast<double>(clear_m[slot(occupied, cell)]) > robot_radius_m;
  };
  const Eigen::Vector2i first = cell_of(occupied, {start.x_m, start.y_m});
  if (!inside(occupied, first) || !free(first)) return drivable;
  std::vector<Eigen::Vector2i> open = {first};
  drivable.cells[slot(drivable, first)] = 255;
  while (!open.empty()) {
    const Eigen::Vector2i cell = open.back();
    open.pop_back();
    for (const Eigen::Vector2i& step :
         {Eigen::Vector2i(1, 0), Eigen::Vector2i(-1, 0), Eigen::Vector2i(0, 1), Eigen::Vector2i(0, -1)}) {
      const Eigen::Vector2i next = cell + step;
      if (!inside(drivable, next) || drivable.cells[slot(drivable, next)] != 0 || !free(next)) continue;
      drivable.cells[slot(drivable, next)] = 255;
      open.push_back(next);
    }
  }
  return drivable;
}

std::vector<Eigen::Vector2d> shortest_way(const FloorGrid& drivable, const Eigen::Vector2d& from_m,
                                          const Eigen::Vector2d& to_m) {
  const Eigen::Vector2i first = nearest_set(drivable, cell_of(drivable, from_m));
  const Eigen::Vector2i last = nearest_set(drivable, cell_of(drivable, to_m));
  if (first.x() < 0 || last.x() < 0) return {};
  FloorGrid walls = drivable;
  for (std::uint8_t& cell : walls.cells) cell = cell != 0 ? 0 : 255;
  const std::vector<float> to_wall_m = clearance(walls);

  const std::size_t count = drivable.cells.size();
  std::vector<float> cost(count, std::numeric_limits<float>::infinity());
  std::vector<int> before(count, -1);
  using Entry = std::pair<float, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto estimate = [&](const Eigen::Vector2i& cell) { return (cell - last).cast<float>().norm(); };
  cost[slot(drivable, first)] = 0.0F;
  open.emplace(estimate(first), static_cast<int>(slot(drivable, first)));
  std::vector<bool> closed(count, false);
  while (!open.empty()) {
    const auto index = static_cast<std::size_t>(open.top().second);
    open.pop();
    if (closed[index]) continue;
    closed[index] = true;
    const Eigen::Vector2i cell(static_cast<int>(index) % drivable.width, static_cast<int>(index) / drivable.width);
    if (cell == last) break;
    for (int du = -1; du <= 1; ++du) {
      for (int dv = -1; dv <= 1; ++dv) {
        const Eigen::Vector2i next = cell + Eigen::Vector2i(du, dv);
        if ((du == 0 && dv == 0) || !inside(drivable, next) || drivable.cells[slot(drivable, next)] == 0) continue;
        const std::size_t next_index = slot(drivable, next);
        // Within 0.4 m beyond the robot's own radius a step costs up to three times as much: ways keep to the middle.
        constexpr float kComfort_m = 0.4F;
        const float near = std::max(0.0F, 1.0F - to_wall_m[next_index] / kComfort_m);
        const float step = std::sqrt(static_cast<float>(du * du + dv * dv)) * (1.0F + 2.0F * near);
        if (cost[index] + step >= cost[next_index]) continue;
        cost[next_index] = cost[index] + step;
        before[next_index] = static_cast<int>(index);
        open.emplace(cost[next_index] + estimate(next), static_cast<int>(next_index));
      }
    }
  }
  if (!closed[slot(drivable, last)]) return {};
  std::vector<Eigen::Vector2d> way_m;
  for (int index = static_cast<int>(slot(drivable, last)); index >= 0;
       index = before[static_cast<std::size_t>(index)]) {
    way_m.push_back(centre_of(drivable, {index % drivable.width, index / drivable.width}));
  }
  std::reverse(way_m.begin(), way_m.end());
  return way_m;
}

double length_m(const std::vector<Eigen::Vector2d>& way_m) {
  double length = 0.0;
  for (std::size_t i = 1; i < way_m.size(); ++i) length += (way_m[i] - way_m[i - 1]).norm();
  return length;
}

Eigen::Vector2d random_free_point(const FloorGrid& drivable, std::mt19937_64& random) {
  for (;;) {
    const std::size_t index = random() % drivable.cells.size();
    if (drivable.cells[index] == 0) continue;
    return centre_of(drivable, {static_cast<int>(index) % drivable.width, static_cast<int>(index) / drivable.width});
  }
}

std::optional<std::string> room_at(const World& world, const Eigen::Vector2d& point_m) {
  for (const Room& room : world.rooms) {
    bool within = false;
    const auto& outline = room.outline_m;
    for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
      const bool crosses = (outline[i].y() > point_m.y()) != (outline[j].y() > point_m.y());
      if (crosses && point_m.x() < (outline[j].x() - outline[i].x()) * (point_m.y() - outline[i].y()) /
                                           (outline[j].y() - outline[i].y()) +
                                       outline[i].x()) {
        within = !within;
      }
    }
    if (within) return room.name;
  }
  return std::nullopt;
}

}  // namespace homeward::sim
