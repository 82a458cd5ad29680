// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "core/range_sweep.hpp"
#include "features/appearance.hpp"
#include "map/topological_map.hpp"
#include "mapping/pair_table.hpp"

namespace homeward::mapping {

/// A tour image that a person gave a name.
struct MarkedImage {
  int image = 0;
  std::string label;
};

/// Tours as the builder sees them: compared images.
struct MappingInput {
  std::span<const map::MapImage> images;  // tour order
  std::span<const int> tour_of;           // number of the tour of each image, ascending
  std::span<const features::Appearance> appearances;
  std::span<const MarkedImage> marks;
  const PairTable* pairs = nullptr;
  std::span<const RangeSweep* const> sweeps = {};  // taken with each image, null: none; may be empty
};

}  // namespace homeward::mapping
