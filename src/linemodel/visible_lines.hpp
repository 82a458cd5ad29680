// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "linemodel/plan.hpp"
#include "raycast/ray_scene.hpp"

namespace homeward::linemodel {

struct VisibilityConfig {
  double cell_m = 0.2;            // side of the squares of the floor in which the same lines are visible
  double piece_m = 0.5;           // lines are cut into pieces of at most so much, each visible or not
  double most_m = 15.0;           // farther lines are left out
  double least_angle_rad = 0.12;  // pieces and lines that look shorter than this are left out
  /// Of what was worked out: once it is more, all is forgotten and worked out anew. A plan of 9,600 lines of glass on
  /// 80 m x 80 m has 0.8 GB.
  std::size_t most_kept_bytes = std::numeric_limits<std::size_t>::max();
};

/// Which lines of a plan are visible from where on its floor, by rays from the height of the camera. A piece of a line
/// is visible in a square when it is from each of its corners that its middle sees: what hides behind a wall from a
/// corner is never visible in it, as far as rays to the middles of pieces tell. Worked out when first asked for, and
/// kept, within limits. Ours. Not thread-safe.
class VisibleLines {
 public:
  /// `plan` is copied. `height_m`: of the camera over the floor.
  VisibleLines(const Plan& plan, double height_m, const VisibilityConfig& config);
  ~VisibleLines();
  VisibleLines(VisibleLines&&) noexcept;
  VisibleLines& operator=(VisibleLines&&) noexcept;

  /// The lines visible around a point of the floor; valid until it is asked for another square.
  [[nodiscard]] std::span<const PlanLine> around(const Eigen::Vector2d& point_m);

 private:
  struct Piece {
    Eigen::Vector3f from_m;
    Eigen::Vector3f to_m;
    std::uint32_t line = 0;
  };
  using Indices = std::vector<std::uint32_t>;  // of pieces, ascending
  using Key = std::int64_t;

  [[nodiscard]] const Indices& from_corner(std::int32_t column, std::int32_t row);
  [[nodiscard]] Indices look_from(const Eigen::Vector3f& eye_m) const;
  [[nodiscard]] std::vector<PlanLine> joined(const Indices& pieces, const Eigen::Vector3f& eye_m) const;

  double height_m_;
  VisibilityConfig config_;
  raycast::RayScene rays_;
  std::vector<Piece> pieces_;
  std::unordered_map<Key, Indices> corners_;
  std::unordered_map<Key, std::vector<PlanLine>> cells_;
  std::size_t kept_bytes_ = 0;  // of both
};

}  // namespace homeward::linemodel
