// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "map/topological_map.hpp"
#include "mapping/mapping_config.hpp"
#include "mapping/mapping_input.hpp"
#include "mapping/sights.hpp"
#include "mapping/tour_path.hpp"
#include "mapping/track.hpp"

namespace homeward::mapping {

/// A stretch of a tour inside one place.
struct Run {
  int place = 0;
  int first = 0;  // image indices
  int last = 0;
};

/// The tours as runs, in tour order; a run ends where its tour does.
std::vector<Run> runs(const MappingInput& input, std::span<const int> place_of_image);

/// For each place the index of the image that is its prototype.
std::vector<int> prototype_images(const MappingInput& input, std::span<const map::Place> places);

/// Two places, the lower index first.
using PlacePair = std::pair<int, int>;

/// Every transition between places that a tour drove, in both directions. `place_of_image` has an index into `places`
/// for each image of the input.
/// Goedemé 2006 §3.3 (links are possible transitions); lengths, bearings and weak edges are ours.
std::vector<map::Edge> form_edges(const MappingInput& input, const TourPath& path, const TourTrack& track,
                                  const MappingConfig& config, std::span<const map::Place> places,
                                  std::span<const int> place_of_image, Sights& sights);

}  // namespace homeward::mapping
