// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "features/appearance.hpp"
#include "map/picture_pair.hpp"
#include "map/topological_map.hpp"

namespace homeward::pipeline {

/// A picture of a map and what is seen in it.
struct LookedAt {
  const ImageId& image;
  const features::Appearance& seen;
};

/// What two pictures of a map have in common, as they lie in their panoramas, so that people can see it too. Matches
/// that agree come first, then the most distinctive ones, at most 2000; a match is the more distinctive the farther its
/// second best is behind (Lowe 2004 §7.1). Where no motion explains what both see, none agrees and there is no turn.
map::PicturePair picture_pair(const map::TopologicalMap& map, const LookedAt& a, const LookedAt& b);

}  // namespace homeward::pipeline
