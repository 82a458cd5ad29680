// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "core/ids.hpp"

namespace homeward::map {

/// What may get worse by edits.
enum class Worsening {
  kLocalisation,  // pictures at `place` are not recognised any more, or taken for another place
  kPictures,      // pictures that came to `place` do not show it
  kPlaces,        // pictures that came to `place` were taken far from it
  kWay,           // the new way from `place` to `other` is seen by no picture
  kFarWay,        // the new way from `place` to `other` is far longer than its prototypes see
  kRoute,         // no open way leads from the destination at `place` to that at `other` any more
  kDrives,        // what drives saw at `place` is not recognised any more, or taken for another place
  kDestination,   // the destination at `place` goes with it
};

inline constexpr std::size_t kWorsenings = 8;

struct WorseSpot {
  Worsening kind = Worsening::kLocalisation;
  PlaceId place;
  PlaceId other;                // of a way or a route; where pictures are taken to be most often
  std::vector<ImageId> images;  // concerned, in tour order; of kDrives, whose pictures are not kept, the prototype
  int of = 0;                   // how many pictures were looked at
  int times = 0;                // how many of them fare worse
  double distance_m = 0.0;      // of kPlaces and kFarWay
};

/// What tours and drives say of an edited map (pipeline/replay_check.hpp).
struct ReplayCheck {
  int pictures = 0;
  int sights = 0;        // of drives, that were localised; not among the pictures
  int right_before = 0;  // recognised at their own place or beside it
  int right_after = 0;
  int lost_before = 0;
  int lost_after = 0;
  int routes_before = 0;  // ordered pairs of destinations with an open way
  int routes_after = 0;
  std::vector<WorseSpot> worse;  // in the order of Worsening

  [[nodiscard]] bool harmless() const { return worse.empty(); }
};

}  // namespace homeward::map
