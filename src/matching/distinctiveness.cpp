// SPDX-License-Identifier: Apache-2.0
#include "matching/distinctiveness.hpp"

#include <cmath>
#include <limits>

#include "matching/nearest.hpp"

namespace homeward::matching {

std::vector<std::uint8_t> document_frequency(const features::FeatureSet& set, std::span<const SeenPlace> places) {
  constexpr std::uint8_t kMost = std::numeric_limits<std::uint8_t>::max();
  const auto count = static_cast<std::size_t>(set.size());
  std::vector<std::uint8_t> frequency(count, 0);
  if (count == 0) return frequency;
  for (const SeenPlace& place : places) {
    std::vector<char> has_like(count, 0);
    for (const features::FeatureSet* seen : place) {
      if (seen->size() == 0 || seen->descriptors.cols() != set.descriptors.cols()) continue;
      const NearestNeighbours nearest = find_nearest(set.descriptors, seen->descriptors);
      for (std::size_t i = 0; i < count; ++i) {
        if (nearest.distance[i] < kAlikeDistance2) has_like[i] = 1;
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (has_like[i] != 0 && frequency[i] < kMost) ++frequency[i];
    }
  }
  return frequency;
}

std::optional<double> distinct_share(std::span<const int> inliers, std::span<const Match> matches,
                                     const features::FeatureSet& target) {
  if (target.document_frequency.empty()) return std::nullopt;
  int agreeing = 0;
  int distinct = 0;
  for (const int inlier : inliers) {
    const Match& match = matches[static_cast<std::size_t>(inlier)];
    if (match.kind != FeatureKind::kSift) continue;
    ++agreeing;
    if (target.document_frequency[static_cast<std::size_t>(match.target)] == 0) ++distinct;
  }
  constexpr double kMoreCommon = 5.0;
  return distinct / (agreeing + kMoreCommon);
}

double not_elsewhere(double distinct_share) { return 1.0 / (1.0 + std::exp(1.0 - 18.0 * distinct_share)); }

}  // namespace homeward::matching
