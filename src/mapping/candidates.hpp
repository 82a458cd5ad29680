// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "core/result.hpp"
#include "features/appearance.hpp"
#include "mapping/pair_table.hpp"

namespace homeward::mapping {

struct CandidateConfig {
  int always_compared = 12;  // tour neighbours this near are compared whatever they look like
  int look_alikes = 24;      // of other images, so many that the index finds most like an image
  double gate_factor = 1.5;  // look-alikes whose colour moments differ more than so many times what is usual (the 99th
                             // percentile) between tour neighbours three images apart are not compared
  int around = 3;            // tour neighbours, each way, of images that were found near each other
  int second_round = 24;     // at most so many pairs for each image in the second round
};

/// Pairs to compare: for each image earlier ones, ascending.
using PairLists = std::vector<std::vector<int>>;

/// Of one tour and not more than `always_compared` images apart.
bool tour_neighbours(std::span<const int> tour_of, int a, int b, const CandidateConfig& config);

/// Tour neighbours, and for each image those others whose features as a whole are most like its own (a retrieval index
/// with words of these images: matching/retrieval_index.hpp). A pair is one if either of its images picks the other.
/// Does not depend on `threads`.
/// Errors: kInvalidInput (descriptors of different lengths), kCancelled.
/// In place of the global colour measure of Goedemé 2007 §4.2.3, which still compares all pairs; what is compared:
/// docs/experiments/pairs_compared.md.
Result<PairLists> first_candidates(std::span<const features::Appearance> appearances, std::span<const int> tour_of,
                                   const CandidateConfig& config, std::uint64_t seed, int threads,
                                   const std::stop_token& stop);

/// What complete linkage needs besides: it only merges images of which every pair was compared. Where images a and b
/// of `table` were found near each other and are no tour neighbours, the tour neighbours of a are to be compared with
/// those of b, and a with what is near b. Near is a visual distance up to the median between tour images `around`
/// apart. Of each image the pairs that most finds speak for, the nearer the more; none that `compared` has already.
/// Ours, because the papers compare all pairs.
PairLists second_candidates(const PairTable& table, const PairLists& compared, std::span<const int> tour_of,
                            const CandidateConfig& config);

}  // namespace homeward::mapping
