// SPDX-License-Identifier: Apache-2.0
#include "matching/match.hpp"

#include <cmath>
#include <cstdint>

#include "features/colour.hpp"

namespace homeward::matching {

std::vector<Match> match(const features::FeatureSet& current, const features::FeatureSet& target,
                         const MatchConfig& config) {
  const Eigen::Index dimension = current.descriptors.cols();
  if (current.size() == 0 || target.size() == 0 || dimension != target.descriptors.cols()) return {};
  return match_nearest(find_nearest(current.descriptors, target.descriptors), current, target, config);
}

std::vector<Match> match_nearest(const NearestNeighbours& nearest, const features::FeatureSet& current,
                                 const features::FeatureSet& target, const MatchConfig& config) {
  const double ratio2 = config.ratio * config.ratio;
  std::vector<Match> matches;
  for (int i = 0; i < current.size(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const int j = nearest.of_current[at];
    if (nearest.of_target[static_cast<std::size_t>(j)] != i) continue;
    // Two equally good ones are no match either, be they perfect.
    if (nearest.distance[at] >= ratio2 * nearest.second_distance[at]) continue;
    if (!features::colours_agree(current.colours.row(i).data(), target.colours.row(j).data(),
                                 config.max_colour_difference)) {
      continue;
    }
    const double ratio = std::sqrt(nearest.distance[at] / static_cast<double>(nearest.second_distance[at]));
    matches.push_back({i, j, FeatureKind::kSift, static_cast<float>(ratio)});
  }
  return matches;
}

}  // namespace homeward::matching
