// SPDX-License-Identifier: Apache-2.0
#include "driving/floor_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "core/angles.hpp"

namespace homeward::driving {
namespace {

constexpr double kCell_m = 0.09;

}  // namespace

FloorDistance::FloorDistance(const DistanceField& field, const Eigen::Vector2d& start_m, const Eigen::Vector2d& goal_m,
                             const FloorRoom& room, double half_side_m)
    : half_cells_(static_cast<int>(std::ceil(half_side_m / kCell_m))),
      side_(2 * half_cells_ + 1),
      step_cost_(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_)),
      target_m_(goal_m) {
  for (std::size_t i = 0; i < step_cost_.size(); ++i) {
    const Eigen::Vector2d at = centre_of(i);
    const auto clear_m = double{field.at(static_cast<float>(at.x()), static_cast<float>(at.y()))};
    if (clear_m < room.apart_m) continue;
    const double crowding = 1.0 - (clear_m - room.crowded_m) / (room.comfortable_m - room.crowded_m);
    step_cost_[i] = static_cast<float>(1.0 + room.crowd_cost * std::clamp(crowding, 0.0, 1.0));
  }
  const auto slot_at = [&](const Eigen::Vector2d& point) {
    return slot_of(static_cast<float>(point.x()), static_cast<float>(point.y()));
  };
  // Where the robot stands it can be, however near things are.
  const std::size_t start = slot_at(start_m);
  step_cost_[start] = std::max(1.0F, step_cost_[start]);
  std::vector<float> reached_m;
  flood(start, reached_m, onward_);
  std::size_t target = slot_at(goal_m);
  if (!std::isfinite(reached_m[target])) {
    reaches_goal_ = false;
    double best_m = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < step_cost_.size(); ++i) {
      if (!std::isfinite(reached_m[i])) continue;
      const double apart = (centre_of(i) - goal_m).norm() + 0.05 * double{reached_m[i]};
      if (apart >= best_m) continue;
      best_m = apart;
      target = i;
    }
    target_m_ = centre_of(target);
  }
  flood(target, left_m_, onward_);
}

std::size_t FloorDistance::slot_of(float x_m, float y_m) const {
  const auto cell = [&](float value_m) {
    return static_cast<std::size_t>(
        std::clamp(static_cast<int>(std::lround(double{value_m} / kCell_m)) + half_cells_, 0, side_ - 1));
  };
  return cell(y_m) * static_cast<std::size_t>(side_) + cell(x_m);
}

Eigen::Vector2d FloorDistance::centre_of(std::size_t slot) const {
  const int column = static_cast<int>(slot) % side_;
  const int row = static_cast<int>(slot) / side_;
  return {kCell_m * (column - half_cells_), kCell_m * (row - half_cells_)};
}

void FloorDistance::flood(std::size_t from, std::vector<float>& way_m, std::vector<int>& onward) const {
  way_m.assign(step_cost_.size(), std::numeric_limits<float>::infinity());
  onward.assign(step_cost_.size(), -1);
  using Entry = std::pair<float, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  way_m[from] = 0.0F;
  open.emplace(0.0F, static_cast<int>(from));
  constexpr auto kStraight_m = static_cast<float>(kCell_m);
  constexpr auto kDiagonal_m = static_cast<float>(kCell_m * 1.41421356);
  while (!open.empty()) {
    const auto [cost_m, index] = open.top();
    open.pop();
    if (cost_m > way_m[static_cast<std::size_t>(index)]) continue;
    const int x = index % side_;
    const int y = index / side_;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if ((dx == 0 && dy == 0) || x + dx < 0 || y + dy < 0 || x + dx >= side_ || y + dy >= side_) continue;
        const int beside = (y + dy) * side_ + x + dx;
        const auto next = static_cast<std::size_t>(beside);
        const float there_m = cost_m + step_cost_[next] * (dx != 0 && dy != 0 ? kDiagonal_m : kStraight_m);
        if (step_cost_[next] == 0.0F || there_m >= way_m[next]) continue;
        way_m[next] = there_m;
        onward[next] = index;
        open.emplace(there_m, beside);
      }
    }
  }
}

float FloorDistance::heading_off_rad(float x_m, float y_m, float heading_rad) const {
  // The direction of some steps together; that of a single one is a multiple of 45 degrees.
  constexpr int kSteps = 5;
  auto slot = static_cast<int>(slot_of(x_m, y_m));
  for (int step = 0; step < kSteps && slot >= 0; ++step) {
    const int next = onward_[static_cast<std::size_t>(slot)];
    if (next < 0) break;
    slot = next;
  }
  const Eigen::Vector2d ahead = centre_of(static_cast<std::size_t>(slot)) - Eigen::Vector2d(double{x_m}, double{y_m});
  if (ahead.norm() < kCell_m) return 0.0F;
  return static_cast<float>(std::abs(wrap_angle(std::atan2(ahead.y(), ahead.x()) - double{heading_rad})));
}

}  // namespace homeward::driving
