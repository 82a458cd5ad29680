// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "matching/match.hpp"

namespace homeward::matching {

/// By what the odds that a match is right are to be multiplied for how far behind its second best is: above 1 where
/// nothing else looks like it, below where the second best is nearly as good. 1 for the average match of its kind.
/// Odds of single matches: Tordoff & Murray, Guided-MLESAC (2005); the line is fitted:
/// docs/experiments/look_alike_matches.md.
double odds_of(const Match& match);

}  // namespace homeward::matching
