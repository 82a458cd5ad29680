// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "map/topological_map.hpp"
#include "mapping/pair_table.hpp"
#include "mapping/track.hpp"

namespace homeward::mapping {

/// "New image `image` shows the place of old image `old_image`", and what their pictures say about each other.
struct Meeting {
  int image = 0;      // of the new tours
  int old_image = 0;  // index into the old map's images; -1: unknown
  PairRelation seen;  // the old image seen from the new one
};

/// How far a way that was driven before and one that is driven now bear each other out. Two meetings are both right
/// only if the old way leads from the one's old image to the other's as the new way leads between their new images: as
/// far away and turned as much. Gives for each meeting the factor max(0, 1 + agreed - contradicted) / (1 + agreed +
/// contradicted) over the others at most `reach` new images away: 1 where neither way can tell, 0 where most exclude
/// it. Only pairs that are further apart than two places, and whose ways are known better than that, have a say: inside
/// one room, a look-alike room agrees with itself. `place_extent_m`: how large a place is.
std::vector<double> meeting_trust(std::span<const Meeting> meetings, const TourTrack& new_way, const TourTrack& old_way,
                                  double place_extent_m, int reach);

}  // namespace homeward::mapping
