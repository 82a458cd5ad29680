// SPDX-License-Identifier: Apache-2.0
#include "scenario/known_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

#include "exploration/visiting_order.hpp"
#include "scenario/exploration_figures.hpp"
#include "sim/floor.hpp"

namespace homeward::scenario {
namespace {

constexpr int kCellEvery = 2;  // cell is looked at,
constexpr int kViewEvery = 4;  // and every so many may be a view

std::vector<Eigen::Vector2d> drivable_points(const sim::FloorGrid& grid, int every) {
  std::vector<Eigen::Vector2d> points_m;
  for (int row = 0; row < grid.height; row += every) {
    for (int column = 0; column < grid.width; column += every) {
      const Eigen::Vector2d at_m = sim::centre_of(grid, {column, row});
      if (sim::is_set(grid, at_m)) points_m.push_back(at_m);
    }
  }
  return points_m;
}

/// Views that together cover nearly everything, each the one that covers most of what is left.
std::vector<Eigen::Vector2d> covering_views(const sim::World& world, double covers_m) {
  constexpr double kLeft = 0.02;
  const std::vector<Eigen::Vector2d> cells_m = drivable_points(world.drivable, kCellEvery);
  const std::vector<Eigen::Vector2d> views_m = drivable_points(world.drivable, kViewEvery);
  std::vector<std::vector<std::size_t>> sees(views_m.size());
  for (std::size_t view = 0; view < views_m.size(); ++view) {
    for (std::size_t cell = 0; cell < cells_m.size(); ++cell) {
      const bool near = (views_m[view] - cells_m[cell]).squaredNorm() <= covers_m * covers_m;
      if (near && in_sight(world, views_m[view], cells_m[cell])) sees[view].push_back(cell);
    }
  }
  std::vector<char> covered(cells_m.size(), 0);
  std::size_t left = cells_m.size();
  std::vector<Eigen::Vector2d> chosen_m;
  while (!sees.empty() && static_cast<double>(left) > kLeft * static_cast<double>(cells_m.size())) {
    const auto gain = [&](const std::vector<std::size_t>& cells) {
      return std::ranges::count_if(cells, [&](std::size_t cell) { return covered[cell] == 0; });
    };
    const auto best = std::ranges::max_element(sees, {}, gain);
    if (gain(*best) == 0) break;
    chosen_m.push_back(views_m[static_cast<std::size_t>(best - sees.begin())]);
    for (const std::size_t cell : *best) {
      if (covered[cell] == 0) --left;
      covered[cell] = 1;
    }
  }
  return chosen_m;
}

/// From one point to each of the others over drivable floor, metres (Dijkstra).
std::vector<double> ways_from(const sim::FloorGrid& grid, const Eigen::Vector2d& from_m,
                              const std::vector<Eigen::Vector2d>& to_m) {
  constexpr double kNever = 1e9;
  const auto index = [&](const Eigen::Vector2i& cell) {
    return static_cast<std::size_t>(cell.y()) * static_cast<std::size_t>(grid.width) +
           static_cast<std::size_t>(cell.x());
  };
  std::vector<double> cost_m(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height), kNever);
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  cost_m[index(sim::cell_of(grid, from_m))] = 0.0;
  open.emplace(0.0, index(sim::cell_of(grid, from_m)));
  constexpr std::array<std::array<int, 2>, 8> kSteps = {
      {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};
  while (!open.empty()) {
    const auto [cost, at] = open.top();
    open.pop();
    if (cost > cost_m[at]) continue;
    const int column = static_cast<int>(at % static_cast<std::size_t>(grid.width));
    const int row = static_cast<int>(at / static_cast<std::size_t>(grid.width));
    for (const auto& [right, up] : kSteps) {
      const Eigen::Vector2i next(column + right, row + up);
      if (next.x() < 0 || next.y() < 0 || next.x() >= grid.width || next.y() >= grid.height) continue;
      if (grid.cells[index(next)] == 0) continue;
      const double further_m = cost + grid.resolution_m * std::hypot(right, up);
      if (further_m >= cost_m[index(next)]) continue;
      cost_m[index(next)] = further_m;
      open.emplace(further_m, index(next));
    }
  }
  std::vector<double> ways_m;
  for (const Eigen::Vector2d& to : to_m) ways_m.push_back(cost_m[index(sim::cell_of(grid, to))]);
  return ways_m;
}

}  // namespace

double known_plan_m(const sim::World& world, const Eigen::Vector2d& from_m, double covers_m) {
  std::vector<Eigen::Vector2d> stops_m = covering_views(world, covers_m);
  stops_m.insert(stops_m.begin(), from_m);
  exploration::StopDistances apart_m;
  for (const Eigen::Vector2d& stop : stops_m) apart_m.push_back(ways_from(world.drivable, stop, stops_m));
  return exploration::order_length_m(exploration::visiting_order(apart_m), apart_m);
}

}  // namespace homeward::scenario
