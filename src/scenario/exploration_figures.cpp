// SPDX-License-Identifier: Apache-2.0
#include "scenario/exploration_figures.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>

#include "sim/floor.hpp"

namespace homeward::scenario {
namespace {

double covered_share(const sim::World& world, const std::vector<Eigen::Vector2d>& views_m, double& reachable_m2) {
  constexpr int kEvery = 2;  // cell is asked
  int asked = 0;
  int covered = 0;
  const sim::FloorGrid& grid = world.drivable;
  for (int row = 0; row < grid.height; row += kEvery) {
    for (int column = 0; column < grid.width; column += kEvery) {
      const Eigen::Vector2d at_m = sim::centre_of(grid, {column, row});
      if (!sim::is_set(grid, at_m)) continue;
      ++asked;
      covered += is_covered(world, views_m, at_m);
    }
  }
  reachable_m2 = asked * kEvery * kEvery * grid.resolution_m * grid.resolution_m;
  return asked > 0 ? static_cast<double>(covered) / asked : 0.0;
}

bool is_mixed(const sim::World& world, const map::Place& place, const std::unordered_map<ImageId, Pose2>& taken) {
  constexpr double kFar_m = 4.0;
  std::set<std::string> rooms;
  std::vector<Eigen::Vector2d> at_m;
  for (const ImageId& member : place.members) {
    const auto truth = taken.find(member);
    if (truth == taken.end()) continue;
    at_m.push_back(position_m(truth->second));
    if (const auto room = sim::room_at(world, at_m.back())) rooms.insert(*room);
    for (const Eigen::Vector2d& other : at_m) {
      if ((other - at_m.back()).norm() > kFar_m) return true;
    }
  }
  return rooms.size() > 1;
}

}  // namespace

bool in_sight(const sim::World& world, const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m) {
  const double step_m = world.occupied.resolution_m;
  const int steps = std::max(1, static_cast<int>((to_m - from_m).norm() / step_m));
  for (int i = 0; i <= steps; ++i) {
    if (sim::is_set(world.occupied, from_m + (to_m - from_m) * i / steps)) return false;
  }
  return true;
}

bool is_covered(const sim::World& world, const std::vector<Eigen::Vector2d>& views_m, const Eigen::Vector2d& at_m) {
  constexpr double kWithin_m = 2.0;
  return std::ranges::any_of(views_m, [&](const Eigen::Vector2d& view) {
    return (view - at_m).norm() <= kWithin_m && in_sight(world, view, at_m);
  });
}

ExplorationFigures exploration_figures(const sim::World& world, const map::TopologicalMap& map,
                                       const std::unordered_map<ImageId, Pose2>& taken) {
  constexpr double kWrong_m = 6.0;
  ExplorationFigures figures;
  std::unordered_map<PlaceId, Eigen::Vector2d> places_m;
  std::vector<Eigen::Vector2d> views_m;
  for (const map::Place& place : map.places) {
    figures.mixed_places += is_mixed(world, place, taken);
    const auto truth = taken.find(place.prototype);
    if (truth == taken.end()) continue;
    places_m.emplace(place.id, position_m(truth->second));
    views_m.push_back(position_m(truth->second));
  }
  for (const map::Edge& edge : map.edges) {
    const auto from = places_m.find(edge.from);
    const auto to = places_m.find(edge.to);
    if (from == places_m.end() || to == places_m.end()) continue;
    figures.wrong_edges += (from->second - to->second).norm() > kWrong_m;
  }
  figures.covered = covered_share(world, views_m, figures.reachable_m2);
  return figures;
}

}  // namespace homeward::scenario
