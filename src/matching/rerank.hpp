// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "features/appearance.hpp"

namespace homeward::matching {

struct RerankConfig {
  int background = 30;             // the rank, among the candidates, of the nearest feature that counts as chance
  double log_scale_spread = 0.35;  // of the sizes of features seen again from near by
};

/// How well each candidate explains the features of a picture. Every feature finds its nearest neighbour in every
/// candidate; a candidate gains by how much nearer that is than the neighbour of rank `background`. What all candidates
/// show alike (lamps, door frames of look-alike floors) so says nothing, and rare features decide (McCann & Lowe 2012,
/// local naive Bayes nearest neighbour). Gains shrink where the sizes differ: near the query's place they agree. No
/// bearings are used, so that a guessed camera serves too. Larger is better; 0 or more.
std::vector<double> rerank(const features::FeatureSet& query, std::span<const features::FeatureSet* const> candidates,
                           const RerankConfig& config);

}  // namespace homeward::matching
