// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <stop_token>

#include "core/result.hpp"
#include "features/appearance.hpp"
#include "mapping/candidates.hpp"
#include "mapping/pair_table.hpp"
#include "matching/visual_distance.hpp"

namespace homeward::mapping {

struct CompareConfig {
  matching::VerifyConfig verify;
  CandidateConfig candidates;
};

/// What `b`, seen from `a`, has to do with it; unverified where too little of both is the same. Deterministic by
/// `seed`.
PairRelation relate(const features::Appearance& a, const features::Appearance& b, const matching::VerifyConfig& config,
                    std::uint64_t seed);

/// Pairs that are to be compared, of those that may be worth it.
using PairFilter = std::function<PairLists(PairLists)>;

/// Compares the pairs of images that may show one place: tour neighbours, what looks alike as a whole (Goedemé 2007
/// §4.2.3: global measure first, features for the survivors), and then what lies around those that were found near each
/// other. Their number grows with the images, not with their square. The table does not depend on `threads` and holds
/// the verified pairs. `progress` gets the share done, from the calling thread.
/// Errors: kInvalidInput (descriptors of different lengths), kCancelled.
Result<PairTable> compare_all(std::span<const features::Appearance> appearances, std::span<const int> tour_of,
                              const CompareConfig& config, std::uint64_t seed, int threads,
                              const std::function<void(double)>& progress, const std::stop_token& stop);

/// The same of those pairs alone that `chosen` leaves.
Result<PairTable> compare_chosen(std::span<const features::Appearance> appearances, std::span<const int> tour_of,
                                 const CompareConfig& config, std::uint64_t seed, int threads,
                                 const std::function<void(double)>& progress, const std::stop_token& stop,
                                 const PairFilter& chosen);

}  // namespace homeward::mapping
