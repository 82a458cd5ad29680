// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "exploration/explored_floor.hpp"

namespace homeward::exploration {

struct ReachConfig {
  double radius_m = 0.35;       // of the circle that the body wants, wherever it goes
  double margin_m = 0.03;       // and so much to each side
  double comfort_m = 0.7;       // nearer to things than that a way costs more,
  double closeness_cost = 2.0;  // up to so much more
};

/// Where a body gets to over floor that was seen to be free, and how far that is: from one point of the floor.
class Reach {
 public:
  /// `barred`: cells that nobody may drive on besides, or none.
  static Reach from(const ExploredFloor& floor, const Eigen::Vector2d& start_m, const ReachConfig& config,
                    const std::vector<std::uint8_t>* barred = nullptr);

  [[nodiscard]] bool reaches(std::size_t cell) const { return cost_m_[cell] < kNever; }
  /// What the way costs: its length, more where it is narrow.
  [[nodiscard]] double cost_m(std::size_t cell) const { return static_cast<double>(cost_m_[cell]); }
  /// Whether it gets anywhere at all.
  [[nodiscard]] bool anywhere() const { return anywhere_; }
  /// The cell within half a metre of a point that it reaches, the nearest to it; nothing where there is none.
  [[nodiscard]] std::optional<std::size_t> nearest(const Eigen::Vector2d& at_m) const;
  /// The way there, start first; empty where it does not reach.
  [[nodiscard]] std::vector<Eigen::Vector2d> way_m(std::size_t cell) const;
  [[nodiscard]] const FloorFrame& frame() const { return frame_; }

 private:
  static constexpr float kNever = 1e9F;
  FloorFrame frame_;
  std::vector<float> cost_m_;
  bool anywhere_ = false;
  std::vector<std::int32_t> before_;  // the cell before on the way, -1: none
};

}  // namespace homeward::exploration
