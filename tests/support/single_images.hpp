// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>
#include <vector>

#include "mapping/subclusters.hpp"

namespace homeward::testing {

/// Subclusters of one image each: at these images, in these clusters.
inline std::vector<mapping::Subcluster> singles_of(const std::vector<std::pair<int, int>>& image_and_cluster) {
  std::vector<mapping::Subcluster> result;
  for (const auto& [image, cluster] : image_and_cluster) result.push_back({cluster, {image}, image});
  return result;
}

/// The same, all in one cluster.
inline std::vector<mapping::Subcluster> singles(const std::vector<int>& images) {
  std::vector<mapping::Subcluster> result;
  for (const int image : images) result.push_back({0, {image}, image});
  return result;
}

/// Where so many images lie along one tour, in images.
inline std::vector<double> positions(int images) {
  std::vector<double> result;
  for (int i = 0; i < images; ++i) result.push_back(i);
  return result;
}

}  // namespace homeward::testing
