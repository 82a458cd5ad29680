// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace homeward::driving {

/// Distance of every cell of a square about the origin to the nearest of some points, as far as it matters.
/// By definition, cell by cell: with few points and a short reach that is enough.
class DistanceField {
 public:
  /// Points outside of the square count for the cells near them, too. Distances end at `far_m`.
  DistanceField(std::span<const Eigen::Vector2d> points_m, double cell_m, int half_cells, double far_m);

  /// Beyond the square nothing is known, and nothing stands in the way.
  [[nodiscard]] float at(float x_m, float y_m) const {
    const int column = static_cast<int>(x_m * per_m_ + offset_);
    const int row = static_cast<int>(y_m * per_m_ + offset_);
    if (column < 0 || row < 0 || column >= side_ || row >= side_) return far_m_;
    return distance_m_[static_cast<std::size_t>(row) * static_cast<std::size_t>(side_) +
                       static_cast<std::size_t>(column)];
  }

 private:
  int side_;
  float per_m_;
  float offset_;
  float far_m_;
  std::vector<float> distance_m_;
};

}  // namespace homeward::driving
