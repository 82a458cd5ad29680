// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

#include "map/topological_map.hpp"
#include "mapping/pair_table.hpp"
#include "mapping/track.hpp"

namespace homeward::mapping {

/// "New image `image` shows the place of old image `old_image`", and what their pictures say about each other.
struct Meeting {
  int image = 0;       // of the new tours
  int old_image = 0;   // index into the old map's images; -1: unknown
  PairRelation seen;   // the old image seen from the new one
  double apart = 0.0;  // how far it lies from there
};

/// How far the two ways bear a meeting out.
struct MeetingTrust {
  double agreed = 0.0;        // sum of the weights of other meetings that go with it
  double contradicted = 0.0;  // and of those that do not

  [[nodiscard]] double factor() const {
    return std::max(0.0, 1.0 + agreed - contradicted) / (1.0 + agreed + contradicted);
  }
};

/// Where the second image of a way lies from the first.
using WayBetween = std::function<TrackPrediction(int, int)>;

/// Holds a way that was driven before against one that is driven now. Two meetings are both right only if the old way
/// leads from the one's old image to the other's as the new way leads between their new images: to the same spot,
/// turned as much; from new to old at either end goes by what the pictures tell of each other. A meeting has the more
/// weight in the others' count the more it is borne out itself (relaxation: Rosenfeld, Hummel, Zucker 1976), so that
/// look-alikes, which go with nothing, do not outvote what goes together. Counted are the others at most `reach` new
/// images away, further than two places: inside one room, a look-alike room agrees with itself. Pairs agree where both
/// ways are known to a place, and contradict each other beyond three standard deviations. `place_extent_m`: how large a
/// place is.
std::vector<MeetingTrust> meeting_trust(std::span<const Meeting> meetings, const WayBetween& new_way,
                                        const WayBetween& old_way, double place_extent_m, int reach);

}  // namespace homeward::mapping
