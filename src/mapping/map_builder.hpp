// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/ids.hpp"
#include "map/topological_map.hpp"
#include "mapping/mapping_config.hpp"
#include "mapping/mapping_input.hpp"
#include "mapping/track.hpp"

namespace homeward::mapping {

/// What the builder found out on its way and the map does not keep: for a report.
struct MappingNotes {
  MappingConfig config;
  float place_distance = 0.0F;      // the visual distance up to which images make one place
  std::vector<int> cluster_of;      // of each image
  std::vector<TrackVerdict> way;    // of the way driven on each of the map's hypotheses
  std::vector<char> taken_back;     // 1 for those accepted until other loops excluded them
  std::vector<char> meets;          // 0 for those whose pictures share too little to have been taken at one spot
  std::vector<double> reliability;  // how far looks could be trusted for each of them
  std::vector<ImageId> extra;       // prototypes of places that were put in where an edge would have been weak
  int weak_before = 0;              // pairs of places whose edge would be weak without them
  int weak_after = 0;               // of these, pairs that extra places do not join by sound edges either
};

/// A map with how it came about.
struct NotedMap {
  map::TopologicalMap map;
  MappingNotes notes;
};

/// Places, edges, destinations, hypotheses and statistics of a map (Goedemé 2006 §3.3-3.6); camera, settings and name
/// are the caller's to fill in. `previous`, or null: its ids, labels, decisions and edits outlive the rebuild.
NotedMap make_noted_map(const MappingInput& input, const MappingConfig& config, const map::TopologicalMap* previous);

/// The same without the notes.
map::TopologicalMap make_map(const MappingInput& input, const MappingConfig& config,
                             const map::TopologicalMap* previous);

}  // namespace homeward::mapping
