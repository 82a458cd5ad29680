// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stop_token>
#include <vector>

#include "core/result.hpp"
#include "map/doubt.hpp"
#include "map/topological_map.hpp"
#include "mapping/doubt_config.hpp"

namespace homeward::mapping {

/// What a person should look at in a map, most useful first: by the probability that the map is wrong times how far
/// its ways depend on it. Found in the map alone: appearances of prototypes, ways, hypotheses, the order of pictures,
/// odometry where there is some. What a person decided comes last. Same map, same list, with any number of threads.
/// Errors: kCancelled.
/// Ours: docs/experiments/doubts.md.
Result<std::vector<map::Doubt>> doubts_of(const map::TopologicalMap& map, const DoubtConfig& config, int threads,
                                          const std::stop_token& stop = {});

}  // namespace homeward::mapping
