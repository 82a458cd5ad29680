// SPDX-License-Identifier: Apache-2.0
#include "mapping/subclusters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/median.hpp"

namespace homeward::mapping {

int medoid(std::span<const int> items, const DistanceFunction& distance) {
  int best = items.front();
  auto best_score = std::tuple(std::numeric_limits<float>::infinity(), std::numeric_limits<double>::infinity());
  for (const int candidate : items) {
    std::vector<float> distances;
    double finite_sum = 0.0;
    for (const int other : items) {
      if (other == candidate) continue;
      distances.push_back(distance(candidate, other));
      // An infinite distance is worse than any that was measured, but must not make all candidates equal.
      finite_sum += std::isfinite(distances.back()) ? static_cast<double>(distances.back()) : 1e6;
    }
    if (distances.empty()) return candidate;
    const double mean = finite_sum / static_cast<double>(distances.size());
    const auto score = std::tuple(median(std::move(distances)), mean);
    if (score < best_score) {
      best_score = score;
      best = candidate;
    }
  }
  return best;
}

std::vector<Subcluster> subclusters(std::span<const int> cluster_of, std::span<const int> tour_of,
                                    std::span<const int> fixed_prototypes, const DistanceFunction& distance) {
  std::vector<Subcluster> result;
  for (std::size_t i = 0; i < cluster_of.size(); ++i) {
    const bool continues = i > 0 && cluster_of[i] == cluster_of[i - 1] && tour_of[i] == tour_of[i - 1];
    if (!continues) result.push_back({cluster_of[i], {}, static_cast<int>(i)});
    result.back().images.push_back(static_cast<int>(i));
  }
  for (Subcluster& subcluster : result) {
    const auto fixed = std::ranges::find_if(subcluster.images, [&](int image) {
      return std::ranges::find(fixed_prototypes, image) != fixed_prototypes.end();
    });
    subcluster.prototype = fixed != subcluster.images.end() ? *fixed : medoid(subcluster.images, distance);
  }
  return result;
}

}  // namespace homeward::mapping
