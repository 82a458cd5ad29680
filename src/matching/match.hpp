// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "features/appearance.hpp"
#include "matching/nearest.hpp"

namespace homeward::matching {

struct MatchConfig {
  double ratio = 0.9;               // to the second best, of descriptor distances
  int max_colour_difference = 100;  // largest difference of one colour invariant, of 254
};

/// Which of an appearance's two sets a match is about.
enum class FeatureKind { kSift, kColumn };

/// Feature `current` of one picture and feature `target` of another that look alike.
struct Match {
  int current = 0;
  int target = 0;
  FeatureKind kind = FeatureKind::kSift;
  float ratio = 1.0F;  // of the distance to that to the second best: near 0 there is nothing else like it
};

/// Mutual nearest neighbours that pass the ratio test in one direction and the colour check. Ascending in `current`.
/// (Goedemé 2007 §3.4; Lowe 2004, §7.1.)
std::vector<Match> match(const features::FeatureSet& current, const features::FeatureSet& target,
                         const MatchConfig& config);

/// The same where the nearest neighbours are known already, of descriptors of any kind.
std::vector<Match> match_nearest(const NearestNeighbours& nearest, const features::FeatureSet& current,
                                 const features::FeatureSet& target, const MatchConfig& config);

}  // namespace homeward::matching
