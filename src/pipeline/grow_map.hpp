// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <stop_token>
#include <vector>

#include "camera/camera_config.hpp"
#include "core/result.hpp"
#include "core/tour.hpp"
#include "map/topological_map.hpp"
#include "mapping/grow.hpp"
#include "pipeline/build_map.hpp"
#include "pipeline/eye.hpp"

namespace homeward::pipeline {

/// A map with more tours in it.
struct ToursAdded {
  mapping::GrownMap grown;
  std::vector<Error> skipped;  // pictures that the map does without, and why
};

/// The eye for pictures that are to be compared with a map: of the map's own camera, or of another one that makes
/// comparable features. Errors: kFeatureConfigMismatch (an older program's map, or a camera of another kind).
Result<Eye> eye_for(const map::TopologicalMap& map, const std::optional<camera::CameraConfig>& camera);

/// Adds tours to a map, see mapping/grow.hpp, and fits its calibration to their pictures and to what the old one told
/// (learn_calibration.hpp). Of `options` the name is not used. The result does not depend on the
/// number of threads. Errors: those of eye_for, look_at_tours and growth_input; kTooFewImages (under 3),
/// kTooFewFeatures, kCancelled.
Result<ToursAdded> add_tours(const map::TopologicalMap& old, const std::vector<const TourSource*>& tours,
                             const std::optional<camera::CameraConfig>& camera, const BuildOptions& options,
                             const ProgressSink& progress = {}, const std::stop_token& stop = {});

}  // namespace homeward::pipeline
