// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/pose2.hpp"
#include "core/range_sweep.hpp"
#include "geometry/sweep_surface.hpp"

namespace homeward::exploration {

/// A cell of the floor by column and row.
struct FloorCell {
  int column = 0;
  int row = 0;
  friend bool operator==(const FloorCell&, const FloorCell&) = default;
};

/// Cells of the floor that can be counted, row by row from the least y on. The frame is that of the exploration: the
/// robot's first pose is its origin.
struct FloorFrame {
  double cell_m = 0.05;
  Eigen::Vector2d origin_m = Eigen::Vector2d::Zero();  // lower left corner
  int columns = 0;
  int rows = 0;

  [[nodiscard]] FloorCell cell(const Eigen::Vector2d& at_m) const {
    // Far outside the grid it does not matter where.
    constexpr double kFar = 1e8;
    const auto number = [&](double off_m) {
      return static_cast<int>(std::floor(std::clamp(off_m / cell_m, -kFar, kFar)));
    };
    return {number(at_m.x() - origin_m.x()), number(at_m.y() - origin_m.y())};
  }
  [[nodiscard]] Eigen::Vector2d centre_m(const FloorCell& cell) const;
  [[nodiscard]] bool holds(const FloorCell& cell) const {
    return cell.column >= 0 && cell.row >= 0 && cell.column < columns && cell.row < rows;
  }
  [[nodiscard]] std::size_t index(const FloorCell& cell) const {
    return static_cast<std::size_t>(cell.row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(cell.column);
  }
  [[nodiscard]] FloorCell cell_at(std::size_t index) const {
    const auto width = static_cast<std::size_t>(columns);
    return {static_cast<int>(index % width), static_cast<int>(index / width)};
  }
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
};

/// What a robot knows of the floor, as it tells another one: plain data, a byte of flags for each cell of `frame`.
struct SharedFloor {
  static constexpr std::uint8_t kFree = 1;
  static constexpr std::uint8_t kOccupied = 2;
  static constexpr std::uint8_t kCovered = 4;  // by a picture
  FloorFrame frame;
  std::vector<std::uint8_t> cells;

  /// The flags at a point of its frame; 0 where it knows nothing.
  [[nodiscard]] std::uint8_t at(const Eigen::Vector2d& at_m) const {
    const FloorCell cell = frame.cell(at_m);
    return frame.holds(cell) ? cells[frame.index(cell)] : std::uint8_t{0};
  }
};

struct FloorConfig {
  double cell_m = 0.05;
  double sees_free_m = 5.0;    // farther off, the rays lie too wide apart to call free what is between them
  double before_hit_m = 0.08;  // the last bit before a hit is not called free
  double margin_m = 1.0;       // around what the sweeps may show
  int hit = 4;                 // evidence of a hit, against
  int pass = 1;                // one of each sweep that looked past,
  int most = 12;               // and no more than that either way
};

/// What sweeps have shown of the floor: what is free, what stands there, and what no ray has passed. A ray that came
/// back with nothing says nothing, as glass gives such.
/// Evidence on a grid of cells: Moravec & Elfes, High resolution maps from wide angle sonar (1985).
class ExploredFloor {
 public:
  explicit ExploredFloor(const FloorConfig& config = {}) : config_(config) { frame_.cell_m = config.cell_m; }

  void see(const RangeSweep& sweep, std::span<const geometry::SurfacePoint> surface, const Pose2& floor_from_robot);
  void forget() { *this = ExploredFloor(config_); }
  /// Where this floor knows nothing, it takes another one's word. `here_from_there`: how that one's frame lies in this.
  void believe(const SharedFloor& other, const Pose2& here_from_there);

  [[nodiscard]] const FloorFrame& frame() const { return frame_; }
  [[nodiscard]] bool is_free(std::size_t cell) const { return evidence_[cell] < 0; }
  [[nodiscard]] bool is_occupied(std::size_t cell) const { return evidence_[cell] > 0; }
  [[nodiscard]] bool is_unknown(std::size_t cell) const { return evidence_[cell] == 0; }
  /// Whether nothing that was seen stands between two points, ends included.
  [[nodiscard]] bool in_sight(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m) const;

 private:
  void grow_to(const Eigen::Vector2d& centre_m, double reach_m);
  void pass(const RangeSweep& sweep, const Pose2& floor_from_scan);
  void add(const FloorCell& cell, int evidence);

  FloorConfig config_;
  FloorFrame frame_;
  std::vector<std::int8_t> evidence_;  // above 0: something stands there, below: free, 0: unknown
};

}  // namespace homeward::exploration
