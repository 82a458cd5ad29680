// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "core/ids.hpp"
#include "core/pose2.hpp"
#include "exploration/explorer.hpp"
#include "map/topological_map.hpp"

namespace homeward::scenario {

/// What an exploration knew of its pictures in the end.
struct ExploredGraph {
  std::vector<ImageId> images;                       // as the map has them
  std::vector<Pose2> poses;                          // of each
  std::vector<exploration::KnownAgain> known_again;  // by the numbers of the images
};

/// Where the map of an exploration's tour differs from the exploration. Neither knows the truth: whoever wants to know
/// which of them is wrong looks at the map's evidence. Places beside each other between which nobody drove have no
/// edge, so that some are missed in maps without a fault.
struct MapAgreement {
  int apart_in_map = 0;   // pictures that share a place with another one more than 4 m off, by the exploration
  int missed_by_map = 0;  // pictures known again by others (and not taken back) that have two places without an edge
};

/// Pictures that the map has in no place are passed over.
MapAgreement map_agreement(const map::TopologicalMap& map, const ExploredGraph& explored);

}  // namespace homeward::scenario
