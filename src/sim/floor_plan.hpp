// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/outline.hpp"
#include "core/pose2.hpp"
#include "sim/box.hpp"
#include "sim/scene.hpp"

namespace homeward::sim {

/// What stands between two heights, as the edges of its triangles seen from above: exact where a grid of the floor
/// rounds to whole cells.
class FloorPlan {
 public:
  explicit FloorPlan(const Scene& scene, double lowest_m = 0.1, double highest_m = 1.4);
  void add(const Box& box);

  /// From the outline to the nearest edge, metres, negative where one reaches into it; at most `far_m`. What holds the
  /// whole outline is not noticed: bodies get into things over their edges.
  [[nodiscard]] double clearance_m(const Outline& outline, const Pose2& pose, double far_m) const;

 private:
  struct Edge {
    Eigen::Vector2f from_m;
    Eigen::Vector2f to_m;
  };
  void add_edge(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m);
  [[nodiscard]] int column_of(double x_m) const;
  [[nodiscard]] int row_of(double y_m) const;
  [[nodiscard]] std::vector<Edge>& tile(int column, int row);
  [[nodiscard]] const std::vector<Edge>& tile(int column, int row) const;

  Eigen::Vector2d origin_m_ = Eigen::Vector2d::Zero();
  int columns_ = 1;
  int rows_ = 1;
  std::vector<std::vector<Edge>> tiles_;  // row by row; an edge is in each tile that its bounding box meets
};

}  // namespace homeward::sim
