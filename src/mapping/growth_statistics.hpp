// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "map/topological_map.hpp"
#include "mapping/growth_input.hpp"
#include "mapping/similarity.hpp"

namespace homeward::mapping {

/// The spreads of a map that new tours joined, over both. A map does not keep what its spreads were measured on, but
/// how much that was follows from its images and places: the new tours' measurements are weighed against the old ones
/// by their numbers. Exact for root mean squares; of the two medians (distance_scale) it is the mean. `place_of_image`:
/// of each image of the input, an index into grown.places. `usual`: of the new tours.
/// Ours: the papers build a map once.
map::MotionStatistics grown_statistics(const map::TopologicalMap& old, const map::TopologicalMap& grown,
                                       const GrowthInput& input, const PairTable& pairs,
                                       std::span<const int> place_of_image, const UsualDistances& usual);

}  // namespace homeward::mapping
