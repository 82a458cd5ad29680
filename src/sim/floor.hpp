// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <random>
#include <vector>

#include "core/pose2.hpp"
#include "raycast/ray_scene.hpp"
#include "sim/scene.hpp"

namespace homeward::sim {

/// The cell of a point: column, row. May lie outside the grid.
Eigen::Vector2i cell_of(const FloorGrid& grid, const Eigen::Vector2d& point_m);
Eigen::Vector2d centre_of(const FloorGrid& grid, const Eigen::Vector2i& cell);
bool is_set(const FloorGrid& grid, const Eigen::Vector2d& point_m);

/// Cells in which some triangle stands between the two heights, over the scene's bounding box and a margin.
FloorGrid occupied_cells(const Scene& scene, double resolution_m, double lowest_m = 0.1, double highest_m = 1.4);

/// Marks the cells of `grid` in which one of these triangles stands between the two heights.
void mark_triangles(FloorGrid& grid, const Scene& scene, Eigen::Index first, Eigen::Index count, double lowest_m = 0.1,
                    double highest_m = 1.4);

/// Distance of every cell's centre to the nearest occupied cell's centre, metres; row-major like the cells.
std::vector<float> clearance(const FloorGrid& occupied);

/// Cells whose clearance exceeds the robot's radius and that are reachable from `start`.
FloorGrid drivable_cells(const FloorGrid& occupied, double robot_radius_m, const Pose2& start);

/// Shortest way over set cells (A*, eight neighbours) that keeps off the walls where there is room; both ends included.
/// Ends that are not set are moved to the nearest set cell. Empty when there is none.
std::vector<Eigen::Vector2d> shortest_way(const FloorGrid& drivable, const Eigen::Vector2d& from_m,
                                          const Eigen::Vector2d& to_m);

double length_m(const std::vector<Eigen::Vector2d>& way_m);

/// A set cell's centre at random. Precondition: some cell is set.
Eigen::Vector2d random_free_point(const FloorGrid& drivable, std::mt19937_64& random);

/// The room whose outline holds the point; without outlines the room whose point is nearest by driving distance is
/// unknown, so nothing.
std::optional<std::string> room_at(const World& world, const Eigen::Vector2d& point_m);

}  // namespace homeward::sim
