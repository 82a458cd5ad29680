// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "map/topological_map.hpp"
#include "mapping/hypotheses.hpp"
#include "mapping/mapping_config.hpp"
#include "mapping/mapping_input.hpp"
#include "mapping/new_places.hpp"
#include "mapping/subclusters.hpp"

namespace homeward::mapping {

/// Images of one place by the side of the doorways on which they were taken: one group where no doorway is between
/// them, or where sweeps do not tell. An image on the threshold is a group of its own: nobody can say which room it
/// is in. Images without a sweep go with the one that they look most like. Groups by their first images, ascending.
/// Precondition: `images` ascending, not empty.
std::vector<std::vector<int>> sides_of_doorways(const MappingInput& input, std::span<const int> images,
                                                const DoorwayConfig& config);

/// Splits places that hold images of both sides of a doorway. A place keeps the images that its prototype goes with,
/// the others become places behind the last. Members are set anew where anything was split.
/// `stays`: places that are left as they are, by their indices; may be empty. `movable`: so many images; those behind
/// stand for old places and stay. Returns how many places were added.
int split_at_doorways(const MappingInput& input, const DoorwayConfig& config, const ImageLabels& labels,
                      const std::vector<char>& stays, int movable, std::vector<map::Place>& places,
                      std::vector<int>& place_of_image);

/// A hypothesis that was accepted, not by a person, and whose prototypes a doorway parts since then, is rejected.
void reject_across(std::vector<LoopHypothesis>& hypotheses, std::span<const Subcluster> parts,
                   std::span<const int> place_of_image);

}  // namespace homeward::mapping
