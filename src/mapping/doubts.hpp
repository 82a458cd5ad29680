// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stop_token>
#include <vector>

#include "core/result.hpp"
#include "map/doubt.hpp"
#include "map/topological_map.hpp"

namespace homeward::mapping {

struct DoubtConfig {
  int look_alikes = 4;              // of each place, the places most like it as a whole that are looked at closely
  int most_compared = 1500;         // pairs of places whose features are compared, those most like each other
  int most_neighbours = 6;          // hypotheses near one that are named
  double usual_detour_m = 5.0;      // a decision that makes ways change by so much has half of the greatest effect
  double least_effect = 0.05;       // of a decision that no way depends on: what is known of a place is kept apart
  double least_probability = 0.02;  // below, nothing is asked
};

/// What a person should look at in a map, most useful first: by the probability that the map is wrong times how far
/// its ways depend on it. Found in the map alone: appearances of prototypes, ways, hypotheses, the order of pictures,
/// odometry where there is some. What a person decided comes last. Same map, same list, with any number of threads.
/// Errors: kCancelled.
/// Ours: docs/experiments/doubts.md.
Result<std::vector<map::Doubt>> doubts_of(const map::TopologicalMap& map, const DoubtConfig& config, int threads,
                                          const std::stop_token& stop = {});

}  // namespace homeward::mapping
