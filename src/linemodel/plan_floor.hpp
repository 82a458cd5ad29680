// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/result.hpp"
#include "linemodel/plan.hpp"

namespace homeward::linemodel {

/// What of a plan stands between two heights, on a grid, and how far from it each point of the floor is.
class PlanSlice {
 public:
  PlanSlice() = default;
  /// `least_m`, `most_m`: heights over the floor.
  PlanSlice(const Plan& plan, double least_m, double most_m);

  /// How far the nearest thing is; 0 outside the plan's rectangle, far (1e3) where nothing stands at these heights.
  [[nodiscard]] float clearance_m(const Eigen::Vector2d& point_m) const;
  /// Whether a point is within the plan's rectangle.
  [[nodiscard]] bool covers(const Eigen::Vector2d& point_m) const;

 private:
  friend class PlanFloor;
  static constexpr double kCell_m = 0.05;

  [[nodiscard]] int column(double x_m) const { return static_cast<int>(std::floor((x_m - least_m_.x()) / kCell_m)); }
  [[nodiscard]] int row(double y_m) const { return static_cast<int>(std::floor((y_m - least_m_.y()) / kCell_m)); }

  Eigen::Vector2d least_m_ = Eigen::Vector2d::Zero();
  int width_ = 0;
  int height_ = 0;
  std::vector<std::uint8_t> occupied_;  // height x width, row 0 at the least y
  std::vector<float> clearance_m_;      // the same
};

/// Where on a plan a robot may be.
class PlanFloor {
 public:
  /// Indoors is over the floor that is drawn, or, where none is, what cannot be reached from outside; all of the
  /// plan's rectangle where that is nothing. Errors: kInvalidInput (the plan's rectangle is larger than 250 m).
  static Result<PlanFloor> of(const Plan& plan);

  /// Whether a robot may be thought to stand there: indoors, off what reaches up to the head. Furniture is no
  /// obstacle, as it may have been moved since the plan was drawn.
  [[nodiscard]] bool free(const Eigen::Vector2d& point_m) const;
  /// The free ones of points kSpacing_m apart, for drawing where a robot may be at all.
  [[nodiscard]] const std::vector<Eigen::Vector2d>& free_points_m() const { return free_points_m_; }
  static constexpr double kSpacing_m = 0.25;

 private:
  void leave_out_small_parts();

  PlanSlice walls_;
  std::vector<std::uint8_t> indoors_;  // cells of walls_
  std::vector<Eigen::Vector2d> free_points_m_;
};

}  // namespace homeward::linemodel
