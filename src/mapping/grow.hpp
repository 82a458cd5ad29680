// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "map/topological_map.hpp"
#include "mapping/growth_input.hpp"
#include "mapping/mapping_config.hpp"
#include "mapping/pair_table.hpp"

namespace homeward::mapping {

/// What tours brought to a map.
struct GrowthCounts {
  int images = 0;
  int joined_images = 0;  // of them, at places that the map had
  int joined_places = 0;  // places that the map had and that gained images
  int places = 0;         // new ones
  int appearances = 0;    // one for each new place
  int edges = 0;          // directed
  int destinations = 0;
  int hypotheses = 0;
};

struct GrownMap {
  map::TopologicalMap map;
  GrowthCounts added;
};

/// Joins new tours to a map by the machinery that makes maps (Goedemé 2006 §3.3-3.6), see close_loops(): complete
/// linkage over new images and the old places' appearances, subclusters by tour order, hypotheses within and across
/// clusters, evidence from what pictures share, from neighbours, from the ways driven and from the loops closed on
/// them, decision by support, and taking back. New images that show an old place join it, the others make new places;
/// transitions that the new tours drove become edges, with extra places of new images where these would be weak. Looks
/// count between old and new as far as they were right where the way could tell, in the old map and on the new tours,
/// and as far as the two ways bear each other out (old_places.hpp). Nothing of the old map is changed or taken away:
/// places keep id, label, prototype, members and appearances, and never merge; edges, decisions and edits stay; an edge
/// that a person removed does not come back; a shortcut that a new tour drives gives way to its edge. Spreads are those
/// of old and new tours together; the calibration stays that of the old map. The revision rises by one.
GrownMap grow_map(const map::TopologicalMap& old, const GrowthInput& input, const PairTable& pairs,
                  const MappingConfig& config);

}  // namespace homeward::mapping
