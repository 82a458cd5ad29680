// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/ids.hpp"
#include "core/range_sweep.hpp"
#include "core/result.hpp"
#include "core/tour.hpp"
#include "features/appearance.hpp"
#include "map/topological_map.hpp"
#include "pipeline/build_map.hpp"

namespace homeward::pipeline {

/// A picture of a tour of the map.
struct KeptPicture {
  ImageId image;
  int tour = 0;
  features::Appearance seen;
  std::optional<RangeSweep> sweep = std::nullopt;  // taken with it
};

/// What may get worse by edits.
enum class Worsening {
  kLocalisation,  // pictures at `place` are not recognised any more, or taken for another place
  kPictures,      // pictures that came to `place` do not show it
  kPlaces,        // pictures that came to `place` were taken far from it
  kWay,           // the new way from `place` to `other` is seen by no picture
  kFarWay,        // the new way from `place` to `other` is far longer than its prototypes see
  kRoute,         // no open way leads from the destination at `place` to that at `other` any more
};

struct WorseSpot {
  Worsening kind = Worsening::kLocalisation;
  PlaceId place;
  PlaceId other;                // of a way or a route; where pictures are taken to be most often
  std::vector<ImageId> images;  // concerned, in tour order
  int of = 0;                   // how many pictures were looked at
  double distance_m = 0.0;      // of kPlaces and kFarWay
};

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

/// Tries edits before they count: localises the pictures of the kept tours on the map before and after them, looks
/// whether pictures that came to a place show it and were taken near it, whether new ways are seen, and whether all
/// destinations still lead to each other. Where pictures come with sweeps, these say what stands between two spots, and
/// what is free. What was no better before is not told. `after` is `before`, edited. The result does not depend on
/// `threads`. Errors: kCancelled. Ours.
Result<ReplayCheck> check_by_replay(const map::TopologicalMap& before, const map::TopologicalMap& after,
                                    const std::vector<KeptPicture>& pictures, int threads,
                                    const std::function<void(double)>& progress = {}, const std::stop_token& stop = {});

/// The same with the pictures of tours, which are looked at first. Pictures that cannot be read are left out. Errors:
/// also those of eye_for and look_at_tours.
Result<ReplayCheck> check_by_replay(const map::TopologicalMap& before, const map::TopologicalMap& after,
                                    const std::vector<const TourSource*>& tours, int threads,
                                    const ProgressSink& progress = {}, const std::stop_token& stop = {});

}  // namespace homeward::pipeline
