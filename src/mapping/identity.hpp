// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "map/topological_map.hpp"

namespace homeward::mapping {

/// Gives places and destinations of a freshly built map, before anybody's edits, their lasting ids: those of `previous`
/// where the images agree (a place: by the greatest overlap of images, each old id at most once; a destination: by its
/// image), new ones otherwise. Places of before count as they were without edits, those that edits made as they are: so
/// the ids of merged places are there again for the edit to merge. Ids of places that are gone are not used again.
/// `previous` may be null. Edges and destinations follow.
/// Before the call the ids in `map` need only be distinct.
/// Ours: the papers build a map once.
void keep_identity(map::TopologicalMap& map, const map::TopologicalMap* previous);

}  // namespace homeward::mapping
