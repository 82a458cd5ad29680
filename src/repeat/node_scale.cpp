// SPDX-License-Identifier: Apache-2.0
#include "repeat/node_scale.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "core/median.hpp"

namespace homeward::repeat {
namespace {

constexpr double kWorstSpread = 0.5;   // of the logarithm of a distance: beyond, it is not known at all
constexpr double kLeastSpread = 0.03;  // however large the parallax: references are taken anew at a node

struct Evidence {
  double log_ratio = 0.0;
  double weight = 0.0;
};

using Matches = std::unordered_map<int, const ArcMatch*>;

Matches by_feature(const Arc& arc) {
  Matches matches;
  for (const ArcMatch& match : arc.matches) matches.emplace(match.feature, &match);
  return matches;
}

double weighted_median(std::vector<Evidence> evidence) {
  std::ranges::sort(evidence, {}, &Evidence::log_ratio);
  double all = 0.0;
  for (const Evidence& e : evidence) all += e.weight;
  double below = 0.0;
  for (const Evidence& e : evidence) {
    below += e.weight;
    if (below >= 0.5 * all) return e.log_ratio;
  }
  return evidence.back().log_ratio;
}

bool has_distance(double nearness, const ArcMatch& match) {
  return nearness > 0.0 && match.distance_spread < kWorstSpread;
}

}  // namespace

std::optional<NodeScale> node_scale(const Arc& before, const Arc& after, int fewest) {
  if (!before.has_baseline || !after.has_baseline) return std::nullopt;
  const Matches known = by_feature(before);
  std::vector<Evidence> evidence;
  for (const ArcMatch& match : after.matches) {
    const auto found = known.find(match.feature);
    if (found == known.end()) continue;
    const ArcMatch& earlier = *found->second;
    if (!has_distance(earlier.to_nearness, earlier) || !has_distance(match.from_nearness, match)) continue;
    const double variance = earlier.distance_spread * earlier.distance_spread +
                            match.distance_spread * match.distance_spread + kLeastSpread * kLeastSpread;
    // Distance in units of the arc before over that in units of the arc after.
    evidence.push_back({std::log(match.from_nearness / earlier.to_nearness), 1.0 / variance});
  }
  if (evidence.empty() || static_cast<int>(evidence.size()) < fewest) return std::nullopt;
  const double middle = weighted_median(evidence);
  std::vector<double> off;
  off.reserve(evidence.size());
  for (const Evidence& e : evidence) off.push_back(std::abs(e.log_ratio - middle));
  return NodeScale{std::exp(middle), static_cast<int>(evidence.size()), 1.4826 * median(std::move(off))};
}

int common_features(const Arc& before, const Arc& after) {
  const Matches known = by_feature(before);
  return static_cast<int>(
      std::ranges::count_if(after.matches, [&](const ArcMatch& match) { return known.contains(match.feature); }));
}

}  // namespace homeward::repeat
