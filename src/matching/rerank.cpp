// SPDX-License-Identifier: Apache-2.0
#include "matching/rerank.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "matching/nearest.hpp"

namespace homeward::matching {
namespace {

constexpr double kFar = 100.0;  // in spreads

}  // namespace

std::vector<double> rerank(const features::FeatureSet& query, std::span<const features::FeatureSet* const> candidates,
                           const RerankConfig& config) {
  std::vector<double> scores(candidates.size(), 0.0);
  if (candidates.empty() || query.size() == 0) return scores;
  const auto count = static_cast<std::size_t>(query.size());
  // For each candidate, the nearest one of each feature of the query; nothing where there can be none.
  std::vector<std::optional<NearestNeighbours>> nearest(candidates.size());
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    if (candidates[c]->size() == 0 || candidates[c]->descriptors.cols() != query.descriptors.cols()) continue;
    nearest[c] = find_nearest(query.descriptors, candidates[c]->descriptors);
  }
  const auto distance = [&](std::size_t c, std::size_t i) {
    return nearest[c] ? nearest[c]->distance[i] : NearestNeighbours::kNone;
  };
  std::vector<std::int32_t> column(candidates.size());
  const std::size_t rank = std::min(static_cast<std::size_t>(std::max(1, config.background)), candidates.size() - 1);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t c = 0; c < candidates.size(); ++c) column[c] = distance(c, i);
    std::nth_element(column.begin(), column.begin() + static_cast<std::ptrdiff_t>(rank), column.end());
    const double chance = column[rank];
    if (chance <= 0.0) continue;
    const auto own = static_cast<Eigen::Index>(i);
    for (std::size_t c = 0; c < candidates.size(); ++c) {
      if (distance(c, i) >= column[rank]) continue;
      const double ratio = static_cast<double>(candidates[c]->scales_rad[nearest[c]->of_current[i]]) /
                           static_cast<double>(query.scales_rad[own]);
      // From the query's own place things have their own size.
      const double scale = ratio > 0.0 ? std::log(ratio) / config.log_scale_spread : kFar;
      scores[c] += (1.0 - distance(c, i) / chance) * std::exp(-0.5 * scale * scale);
    }
  }
  return scores;
}

}  // namespace homeward::matching
