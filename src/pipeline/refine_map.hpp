// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <stop_token>
#include <vector>

#include "camera/camera_config.hpp"
#include "core/result.hpp"
#include "map/topological_map.hpp"
#include "mapping/refine.hpp"
#include "pipeline/build_map.hpp"
#include "pipeline/tour.hpp"

namespace homeward::pipeline {

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

/// Refines a map by pictures taken while driving, in driving order. A picture speaks for a place when the belief is
/// sure (see options), the next picture's as well and near it, and verified geometry says that it was taken there and
/// not between places. Errors: those of eye_for and look_at_tours; kCancelled.
Result<RefinedMap> refine_map(const map::TopologicalMap& map, const TourSource& drive,
                              const std::optional<camera::CameraConfig>& camera, const RefineOptions& options,
                              const ProgressSink& progress = {}, std::stop_token stop = {});

}  // namespace homeward::pipeline
