// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "driving/distance_field.hpp"

namespace homeward::driving {

/// How far a body's turning point has to keep from things, and how far it likes to.
struct FloorRoom {
  double apart_m = 0.0;        // nowhere nearer than this
  double crowded_m = 0.0;      // so near a metre costs the most,
  double comfortable_m = 0.0;  // and from here on nothing extra
  double crowd_cost = 0.0;     // the most that a metre costs extra
};

/// What the way to a goal still costs from every point of the floor about the robot, round whatever stands there: in
/// metres, crowded ones counted for more.
/// Dijkstra (1959) over a grid; the cost of crowded ground is ours.
class FloorDistance {
 public:
  /// A goal that cannot be reached from `start_m` is replaced by the point nearest to it that can.
  FloorDistance(const DistanceField& field, const Eigen::Vector2d& start_m, const Eigen::Vector2d& goal_m,
                const FloorRoom& room, double half_side_m);

  /// Infinite where there is no way.
  [[nodiscard]] float left_m(float x_m, float y_m) const { return left_m_[slot_of(x_m, y_m)]; }
  /// Between a heading and the direction of the way from there, [0, pi].
  [[nodiscard]] float heading_off_rad(float x_m, float y_m, float heading_rad) const;
  [[nodiscard]] const Eigen::Vector2d& target_m() const { return target_m_; }
  [[nodiscard]] bool reaches_goal() const { return reaches_goal_; }

 private:
  [[nodiscard]] std::size_t slot_of(float x_m, float y_m) const;
  [[nodiscard]] Eigen::Vector2d centre_of(std::size_t slot) const;
  /// Dijkstra over eight neighbours; `onward`: the neighbour through which each was reached.
  void flood(std::size_t from, std::vector<float>& way_m, std::vector<int>& onward) const;

  int half_cells_;
  int side_;
  std::vector<float> step_cost_;  // of a metre; 0: not free
  std::vector<float> left_m_;
  std::vector<int> onward_;
  Eigen::Vector2d target_m_;
  bool reaches_goal_ = true;
};

}  // namespace homeward::driving
