// SPDX-License-Identifier: Apache-2.0
#include "matching/match_odds.hpp"

#include <algorithm>
#include <cmath>

namespace homeward::matching {

// How often each ratio occurs among matches that agree with a motion known to be right over how often among those that
// do not, on pairs of the rendered house and of two real corridors: its logarithm is nearly a line, the same for pairs
// near and far. It is not followed to the end, where what looks unique is often a repetition out of sight.
double odds_of(const Match& match) {
  constexpr double kMostLogOdds = 2.0;
  const bool column = match.kind == FeatureKind::kColumn;
  const double per_ratio = column ? 4.0 : 6.2;
  const double neutral_ratio = column ? 0.62 : 0.71;
  const double log_odds = per_ratio * (neutral_ratio - static_cast<double>(match.ratio));
  return std::exp(std::min(kMostLogOdds, log_odds));
}

}  // namespace homeward::matching
