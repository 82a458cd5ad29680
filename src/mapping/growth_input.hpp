// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <stop_token>
#include <vector>

#include "core/range_sweep.hpp"
#include "core/result.hpp"
#include "features/appearance.hpp"
#include "map/topological_map.hpp"
#include "mapping/compare_all.hpp"
#include "mapping/mapping_input.hpp"
#include "mapping/pair_table.hpp"

namespace homeward::mapping {

/// Tours to be added to a map.
struct NewTours {
  std::vector<map::MapImage> images;  // tour order
  std::vector<int> tour_of;           // number of the tour of each image, ascending from 0
  std::vector<features::Appearance> appearances;
  std::vector<MarkedImage> marks;
  std::vector<const RangeSweep*> sweeps = {};  // of each image, null: none; may be empty
};

/// New tours and an old map side by side. A map keeps no appearances of its images but those of its places: each of
/// them stands as one more image behind the new ones, an anchor, in a tour of its own. Ours.
struct GrowthInput {
  std::vector<map::MapImage> images;  // the new ones, then for each anchor the prototype of its place
  std::vector<int> tour_of;
  std::vector<features::Appearance> appearances;
  std::vector<MarkedImage> marks;         // of new images
  std::vector<const RangeSweep*> sweeps;  // of each image, null for anchors; may be empty
  std::vector<int> place_of_anchor;       // index of a place of the old map
  int new_images = 0;

  [[nodiscard]] bool is_anchor(int image) const { return image >= new_images; }
  /// The place that an anchor belongs to.
  [[nodiscard]] int anchored(int image) const { return place_of_anchor[static_cast<std::size_t>(image - new_images)]; }
};

/// Errors: kInvalidInput (an image that the map has already, or one that occurs twice: names it).
Result<GrowthInput> growth_input(const map::TopologicalMap& old, NewTours tours);

/// Compares new images with each other and with the anchors, like compare_all; never two anchors. The table does not
/// depend on `threads`. Errors: kInvalidInput (descriptors of different lengths), kCancelled.
Result<PairTable> compare_with_map(const GrowthInput& input, const CompareConfig& config, std::uint64_t seed,
                                   int threads, const std::function<void(double)>& progress,
                                   const std::stop_token& stop);

}  // namespace homeward::mapping
