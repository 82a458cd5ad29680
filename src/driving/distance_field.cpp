// SPDX-License-Identifier: Apache-2.0
#include "driving/distance_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace homeward::driving {

DistanceField::DistanceField(std::span<const Eigen::Vector2d> points_m, double cell_m, int half_cells, double far_m)
    : side_(2 * half_cells + 1),
      per_m_(static_cast<float>(1.0 / cell_m)),
      offset_(static_cast<float>(half_cells) + 0.5F),
      far_m_(static_cast<float>(far_m)),
      distance_m_(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_), far_m_ * far_m_) {
  const int reach = static_cast<int>(std::ceil(far_m / cell_m));
  const auto cell = static_cast<float>(cell_m);
  // Sweeps hit a wall with many points in one cell; one of them is enough.
  const int wide = side_ + 2 * reach;
  std::vector<std::uint8_t> taken(static_cast<std::size_t>(wide) * static_cast<std::size_t>(wide), 0);
  for (const Eigen::Vector2d& point : points_m) {
    const int middle_x = static_cast<int>(std::lround(point.x() / cell_m)) + half_cells;
    const int middle_y = static_cast<int>(std::lround(point.y() / cell_m)) + half_cells;
    if (std::min(middle_x, middle_y) < -reach || std::max(middle_x, middle_y) >= side_ + reach) continue;
    std::uint8_t& here = taken[static_cast<std::size_t>(middle_y + reach) * static_cast<std::size_t>(wide) +
                               static_cast<std::size_t>(middle_x + reach)];
    if (here != 0) continue;
    here = 1;
    const auto x_m = static_cast<float>(point.x());
    const auto y_m = static_cast<float>(point.y());
    const int first = std::max(0, middle_x - reach);
    const int last = std::min(side_ - 1, middle_x + reach);
    for (int row = std::max(0, middle_y - reach); row <= std::min(side_ - 1, middle_y + reach); ++row) {
      const float dy = static_cast<float>(row - half_cells) * cell - y_m;
      float* squared = distance_m_.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(side_);
      for (int column = first; column <= last; ++column) {
        const float dx = static_cast<float>(column - half_cells) * cell - x_m;
        squared[column] = std::min(squared[column], dx * dx + dy * dy);
      }
    }
  }
  for (float& value : distance_m_) value = std::sqrt(value);
}

}  // namespace homeward::driving
