// SPDX-License-Identifier: Apache-2.0
#include "sim/generate/finish.hpp"

#include <algorithm>
#include <cmath>

#include "sim/floor.hpp"
#include "sim/triangles.hpp"

namespace homeward::sim {
namespace {

constexpr double kRobotRadius_m = 0.35;

/// The free spot that is roomy and near the middle.
Eigen::Vector2d room_point(const FloorGrid& grid, const std::vector<float>& clear_m, const Space& space) {
  const Eigen::Vector2d middle_m = 0.5 * (space.least_m + space.most_m);
  Eigen::Vector2d best_m = middle_m;
  double best = -1e9;
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      const Eigen::Vector2d point_m = centre_of(grid, {column, row});
      if ((point_m.array() < space.least_m.array()).any() || (point_m.array() > space.most_m.array()).any()) continue;
      const auto index =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.width) + static_cast<std::size_t>(column);
      const double score = std::min(0.9, static_cast<double>(clear_m[index])) - 0.15 * (point_m - middle_m).norm();
      if (score > best) {
        best = score;
        best_m = point_m;
      }
    }
  }
  return best_m;
}

}  // namespace

bool finish_world(World& world, const std::vector<Space>& spaces) {
  constexpr double kCell_m = 0.05;
  world.occupied = occupied_cells(world.scene, kCell_m);
  const std::vector<float> clear_m = clearance(world.occupied);
  world.rooms.clear();
  for (const Space& space : spaces) {
    if (space.name.empty()) continue;
    const Eigen::Vector2d point_m = room_point(world.occupied, clear_m, space);
    Room room{space.name, point_m.x(), point_m.y(), {}};
    room.outline_m = {
        space.least_m, {space.most_m.x(), space.least_m.y()}, space.most_m, {space.least_m.x(), space.most_m.y()}};
    world.rooms.push_back(std::move(room));
  }
  world.start = {world.rooms.front().x_m, world.rooms.front().y_m, 0.0};
  world.drivable = drivable_cells(world.occupied, kRobotRadius_m, world.start);
  return std::all_of(world.rooms.begin(), world.rooms.end(), [&](const Room& room) {
    return is_set(world.drivable, {room.x_m, room.y_m});
  });
}

void name_rooms_of(World& world) {
  for (Furniture& piece : world.furniture) {
    Eigen::Vector2d middle_m = Eigen::Vector2d::Zero();
    for (Eigen::Index t = piece.first; t < piece.first + piece.count; ++t) {
      middle_m += corners_m(world.scene, t)[0].head<2>();
    }
    middle_m /= static_cast<double>(piece.count);
    for (const Room& room : world.rooms) {
      const Eigen::Vector2d& least_m = room.outline_m[0];
      const Eigen::Vector2d& most_m = room.outline_m[2];
      if ((middle_m.array() > least_m.array()).all() && (middle_m.array() < most_m.array()).all())
        piece.room = room.name;
    }
  }
}

}  // namespace homeward::sim
