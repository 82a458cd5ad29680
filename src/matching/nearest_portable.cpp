// SPDX-License-Identifier: Apache-2.0
#include "matching/nearest.hpp"

namespace homeward::matching {

NearestNeighbours find_nearest_portable(const ByteDescriptors& current, const ByteDescriptors& target) {
  NearestNeighbours nearest(current.rows(), target.rows());
  std::vector<std::int32_t> target_distance(static_cast<std::size_t>(target.rows()), NearestNeighbours::kNone);
  for (Eigen::Index i = 0; i < current.rows(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    for (Eigen::Index j = 0; j < target.rows(); ++j) {
      std::int32_t distance = 0;
      for (Eigen::Index d = 0; d < current.cols(); ++d) {
        const std::int32_t difference = current(i, d) - target(j, d);
        distance += difference * difference;
      }
      if (distance < nearest.distance[at]) {
        nearest.second_distance[at] = nearest.distance[at];
        nearest.distance[at] = distance;
        nearest.of_current[at] = static_cast<std::int32_t>(j);
      } else if (distance < nearest.second_distance[at]) {
        nearest.second_distance[at] = distance;
      }
      auto& closest = target_distance[static_cast<std::size_t>(j)];
      if (distance < closest) {
        closest = distance;
        nearest.of_target[static_cast<std::size_t>(j)] = static_cast<std::int32_t>(i);
      }
    }
  }
  return nearest;
}

}  // namespace homeward::matching
