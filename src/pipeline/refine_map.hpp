// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "camera/camera_config.hpp"
#include "core/result.hpp"
#include "core/tour.hpp"
#include "features/appearance.hpp"
#include "localisation/localiser.hpp"
#include "map/topological_map.hpp"
#include "mapping/refine.hpp"
#include "pipeline/build_map.hpp"

namespace homeward::pipeline {

/// The size of a map for each place, on average, that refining does not pass unless told otherwise.
inline constexpr std::int64_t kRefinedBytesPerPlace = 32'000;

struct RefineOptions {
  double least_probability = 0.95;  // calibrated, that the robot is at a place or its neighbours
  int least_updates = 3;            // pictures that the belief rests on
  int fewest_inliers = 20;          // matches that one motion between picture and place explains
  double closeness = 0.75;  // a picture at a place is so much closer to its prototype than the next prototype is
  mapping::RefineConfig refine;
  std::int64_t spare_bytes = 0;  // that the map may grow by
  int threads = 0;
};

/// A map that knows more appearances of its places.
struct RefinedMap {
  map::TopologicalMap map;
  mapping::Refinement refinement;
  std::vector<ImageId> images;  // pictures looked at, in driving order; what was gained names them by number
  std::vector<Error> skipped;   // could not be read
  std::vector<PlaceId> sure;    // the place of each of them where it is certain, else empty
};

/// A picture taken while driving that need not be looked at again.
struct DriveSight {
  features::Appearance seen;  // not looked at where `place` is empty
  PlaceId place;              // that the belief was sure of (sure_place); empty between two drives too
};

/// What a map gains by sights.
struct RefinedBySights {
  map::TopologicalMap map;
  mapping::Refinement refinement;
  std::vector<PlaceId> sure;  // the place of each sight where it is certain, else empty
};

/// The place that a belief is sure of by `least_probability` and `least_updates`, else an empty id.
PlaceId sure_place(const localisation::Belief& belief, const RefineOptions& options);

/// Refines a map by sights, in driving order. A sight speaks for a place when the belief was sure (see options), that
/// of the next sight as well and near it, and verified geometry says that it was taken there and not between places.
/// Places that the map does not have (any more) are passed over. Errors: kCancelled.
/// Ours (which sights count); the choice among them: mapping/refine.hpp.
Result<RefinedBySights> refine_by_sights(const map::TopologicalMap& map, std::span<const DriveSight> sights,
                                         const RefineOptions& options, const std::stop_token& stop = {});

/// Refines a map by pictures taken while driving, in driving order: localises them and goes on as refine_by_sights.
/// Errors: those of eye_for and look_at_tours; kCancelled.
Result<RefinedMap> refine_map(const map::TopologicalMap& map, const TourSource& drive,
                              const std::optional<camera::CameraConfig>& camera, const RefineOptions& options,
                              const ProgressSink& progress = {}, const std::stop_token& stop = {});

}  // namespace homeward::pipeline
