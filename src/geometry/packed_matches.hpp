// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "geometry/correspondence.hpp"
#include "geometry/relative_pose.hpp"

namespace homeward::geometry {

/// Matches one coordinate after another in single precision, so that vector instructions judge several at a time.
class PackedMatches {
 public:
  /// The matches at `indices`, each with the weight that its residual has in the cost (as many as indices).
  PackedMatches(std::span<const Correspondence> correspondences, std::span<const int> indices,
                std::span<const double> weights);

  /// Weighted sum of truncated squared errors in units of the bound (MSAC, Torr & Zisserman 2000). Stops adding as
  /// soon as the sum is above `enough`: what it gives then is only known to be above.
  [[nodiscard]] float cost(const PlanarMotion& motion, float bound_rad, float enough) const;

  /// The same for any essential matrix of unit direction.
  [[nodiscard]] float cost(const Eigen::Matrix3d& essential, float bound_rad, float enough) const;

  /// The sum of all weights: the cost of a motion that explains nothing.
  [[nodiscard]] float total_weight() const { return total_weight_; }

 private:
  static constexpr Eigen::Index kLanes = 8;
  using Lanes = Eigen::Array<float, kLanes, 1>;
  using Row = std::vector<Lanes, Eigen::aligned_allocator<Lanes>>;

  Row current_x_, current_y_, current_z_, target_x_, target_y_, target_z_, heights2_, weight_;
  float total_weight_ = 0.0F;
};

}  // namespace homeward::geometry
