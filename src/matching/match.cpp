// SPDX-License-Identifier: Apache-2.0
#include "matching/match.hpp"

#include <cstdint>
#include <cstdlib>

#include "matching/nearest.hpp"

namespace homeward::matching {
namespace {

bool colours_agree(const features::FeatureSet& a, int i, const features::FeatureSet& b, int j, int bound) {
  for (Eigen::Index band = 0; band < 3; ++band) {
    if (std::abs(static_cast<int>(a.colours(i, band)) - static_cast<int>(b.colours(j, band))) > bound) return false;
  }
  return true;
}

}  // namespace

std::vector<Match> match(const features::FeatureSet& current, const features::FeatureSet& target,
                         const MatchConfig& config) {
  const Eigen::Index dimension = current.descriptors.cols();
  if (current.size() == 0 || target.size() == 0 || dimension != target.descriptors.cols()) return {};
  const NearestNeighbours nearest = find_nearest(current.descriptors, target.descriptors);
  const double ratio2 = config.ratio * config.ratio;
  std::vector<Match> matches;
  for (int i = 0; i < current.size(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const int j = nearest.of_current[at];
    if (nearest.of_target[static_cast<std::size_t>(j)] != i) continue;
    // Two equally good ones are no match either, be they perfect.
    if (nearest.distance[at] >= ratio2 * nearest.second_distance[at]) continue;
    if (!colours_agree(current, i, target, j, config.max_colour_difference)) continue;
    matches.push_back({i, j});
  }
  return matches;
}

}  // namespace homeward::matching
