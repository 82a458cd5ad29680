// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "map/topological_map.hpp"
#include "mapping/edges.hpp"
#include "mapping/mapping_config.hpp"
#include "mapping/mapping_input.hpp"
#include "mapping/sights.hpp"
#include "mapping/subclusters.hpp"

namespace homeward::mapping {

/// What insert_extra_places did.
struct ExtraPlaces {
  std::vector<int> prototypes;  // images that became places of their own, in tour order of the ways they mend
  int weak_before = 0;          // pairs of places with a transition whose edge would be weak
  int weak_after = 0;           // of these, pairs that no chain of sound edges over extra places joins
};

/// Images that a map keeps where they are: marked ones and those that stand for subclusters.
std::vector<int> pinned_images(const MappingInput& input, std::span<const Subcluster> parts);

/// Puts tour images as places of their own wherever a tour went from one place to another and the edge would be weak.
/// The image comes from between the two prototypes of a drive and is the one that both ends see best; where one of its
/// own two edges is weak still, another is looked for on that side, up to `extra_place_depth` deep. It is done only if
/// it helps: if all edges of the chain are sound, or the only weak one is surer than the one it replaces. Images of all
/// drives between the two that look more like a new place than like their own move into it; where a drive still goes
/// directly, the weak edge stays beside the sound ones.
/// `pinned`: images that stay where they are, see pinned_images. `settled`: of two places, by their indices, whether
/// nothing is to be put in between them. Places are appended.
/// Ours: docs/experiments/weak_edges.md.
ExtraPlaces insert_extra_places(const MappingInput& input, const MappingConfig& config, std::span<const int> pinned,
                                Sights& sights, std::vector<map::Place>& places, std::vector<int>& place_of_image,
                                const std::function<bool(int, int)>& settled = {});

}  // namespace homeward::mapping
