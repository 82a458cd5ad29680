// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "mapping/closed_way.hpp"
#include "mapping/hypotheses.hpp"
#include "mapping/pair_table.hpp"
#include "mapping/subclusters.hpp"
#include "mapping/track.hpp"

namespace homeward::mapping {

/// The way driven with all accepted hypotheses as closed loops, and what the others say about each of them.
struct WayWithLoops {
  ClosedWay way;
  std::vector<int> tie_of;                  // of each hypothesis, -1 where it is not accepted or the way is broken
  std::vector<std::size_t> hypothesis_of;   // of each tie
  std::vector<LoopTie> ties;                // by group: one run of hypotheses along two passes of the tour
  std::vector<ClosedWay::Without> without;  // of each tie
};

WayWithLoops close_way(std::span<const LoopHypothesis> hypotheses, std::span<const Subcluster> subclusters,
                       const PairTable& pairs, const TourTrack& track, const HypothesisConfig& config);

/// Accepted hypotheses that the way and the other loops exclude, by their indices, ascending. Asked is for each stretch
/// of the tour that a run of them recognises: where would it lie, had it never been recognised? One run alone does not
/// do: where a stretch is taken for a wrong place, it mostly is by every earlier pass of that place, and these runs
/// agree. The worst stretch first, each with those before it gone: a false run makes right ones look wrong, but less
/// than they do it. A person's decision is never taken back.
/// Ours: the papers never take a loop back (Goedemé 2006 §3.6), and one wrong loop bends all of a map.
std::vector<std::size_t> take_back(std::span<const LoopHypothesis> hypotheses, std::span<const Subcluster> subclusters,
                                   const PairTable& pairs, const TourTrack& track, const HypothesisConfig& config);

}  // namespace homeward::mapping
