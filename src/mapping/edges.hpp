// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "map/topological_map.hpp"
#include "mapping/map_builder.hpp"
#include "mapping/track.hpp"

namespace homeward::mapping {

/// Every transition between places that a tour drove, in both directions. `place_of_image` has an index into `places`
/// for each image of the input.
std::vector<map::Edge> form_edges(const MappingInput& input, const TourPath& path, const TourTrack& track,
                                  const MappingConfig& config, std::span<const map::Place> places,
                                  std::span<const int> place_of_image);

}  // namespace homeward::mapping
