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
};

inline constexpr std::size_t kWorsenings = 6;

struct WorseSpot {
  Worsening kind = Worsening::kLocalisation;
  PlaceId place;
  PlaceId other;                // of a way or a route; where pictures are taken to be most often
  std::vector<ImageId> images;  // concerned, in tour order
  int of = 0;                   // how many pictures were looked at
  double distance_m = 0.0;      // of kPlaces and kFarWay
};

/// What tours say of an edited map (pipeline/replay_check.hpp).
struct ReplayCheck {
  int pictures = 0;
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
