// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/pose2.hpp"
#include "geometry/sweep_surface.hpp"

namespace homeward::geometry {

/// Surfaces of earlier sweeps in one frame, to which a new sweep is aligned.
class ReferenceSurface {
 public:
  /// `reference_from_robot`: where the robot was at that sweep.
  void add(std::span<const SurfacePoint> surface, const Pose2& reference_from_robot);
  /// The nearest point within `most_m` that faces about the same way; null where there is none.
  [[nodiscard]] const SurfacePoint* nearest(const SurfacePoint& seen, double most_m) const;
  /// Whether there is such a point: sooner answered than which one is the nearest.
  [[nodiscard]] bool has_near(const SurfacePoint& seen, double most_m) const;

 private:
  struct Cell {
    std::int64_t key = 0;
    std::vector<SurfacePoint> points;
  };
  /// Where a cell's number is in `slots_`, or else would be. There is a free one.
  [[nodiscard]] std::size_t slot_of(std::int64_t key) const;
  [[nodiscard]] Cell& cell_with(std::int64_t key);
  /// Calls `see` with the points of each cell that reaches within `most_m` of a point, until it gives true; whether it
  /// did.
  template <class See>
  bool any_cell_near(const Eigen::Vector2d& at_m, double most_m, const See& see) const;

  std::vector<Cell> cells_;
  std::vector<std::int32_t> slots_;  // a power of two of them, at most half of them taken: numbers of cells, or kFree
};

struct AlignmentConfig {
  double reach_m = 0.4;         // a partner may lie so far off at first,
  double least_reach_m = 0.12;  // and so far in the end
  double scale_m = 0.03;        // distances above count less and less (Cauchy)
  double noise_m = 0.02;        // of one point
  double agrees_m = 0.08;       // so near to its partner, a point agrees
  int iterations = 20;
  int together = 15;  // so many points of one surface say no more than one: their errors are common
};

/// What is known of a pose before the sweep is looked at.
struct PosePrior {
  Pose2 reference_from_robot;
  double spread_m = 0.05;
  double spread_rad = 0.03;
};

/// A sweep put onto the surfaces of others.
struct Alignment {
  Pose2 reference_from_robot;
  double agreement = 0.0;  // share of its points that lie on a surface of the reference
};

/// The pose at which the sweep's surface lies best on the reference's, near to what is known of it; nothing where
/// fewer than a tenth of the points find a partner.
/// Point-to-line iterative closest points (Censi, An ICP variant using a point-to-line metric, ICRA 2008), with
/// Cauchy's weights; the prior holds what the surfaces leave open, as along a corridor.
std::optional<Alignment> align(const ReferenceSurface& reference, std::span<const SurfacePoint> surface,
                               const PosePrior& prior, const AlignmentConfig& config = {});

/// Share of the points that would lie on a surface of the reference at a pose.
double agreement(const ReferenceSurface& reference, std::span<const SurfacePoint> surface,
                 const Pose2& reference_from_robot, double within_m);

}  // namespace homeward::geometry
