// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <stop_token>

#include "core/result.hpp"
#include "features/appearance.hpp"
#include "mapping/pair_table.hpp"
#include "matching/visual_distance.hpp"

namespace homeward::mapping {

struct CompareConfig {
  matching::VerifyConfig verify;
  int always_compared = 12;  // tour neighbours this near are compared whatever their colours
  double gate_factor = 1.5;  // pairs whose colour moments differ more than so many times what is usual (the 99th
                             // percentile) between tour neighbours three images apart are not compared
};

/// Compares all pairs of images whose colours do not rule it out (Goedemé 2007 §4.2.3: global measure first, features
/// for the survivors). The table does not depend on `threads`. `progress` gets the share done, from the calling thread.
/// Errors: kCancelled.
Result<PairTable> compare_all(std::span<const features::Appearance> appearances, std::span<const int> tour_of,
                              const CompareConfig& config, std::uint64_t seed, int threads,
                              const std::function<void(double)>& progress, const std::stop_token& stop);

}  // namespace homeward::mapping
