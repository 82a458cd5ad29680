// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "camera/camera_config.hpp"
#include "core/result.hpp"
#include "map/topological_map.hpp"
#include "pipeline/tour.hpp"

namespace homeward::pipeline {

/// How far a build is. Called from the building thread.
struct BuildProgress {
  std::string stage;   // "features", "compare", "cluster", "places"
  double share = 0.0;  // of the whole build, rises from 0 to 1
};
using ProgressSink = std::function<void(const BuildProgress&)>;

struct BuildOptions {
  std::string name;
  int threads = 0;  // 0: as many as the machine has. The map does not depend on it
  std::uint64_t seed = 1;
};

/// Builds the map of one or more tours with the same camera. Same input, same map, whatever the number of threads.
/// `previous`: a map whose ids, labels, destinations and edits outlive the rebuild, or null.
/// Errors: kEmptyInput, kTooFewImages (under 3), kTooFewFeatures (names the share of pictures without texture),
/// kWrongImageSize, kCancelled, those of TourSource::read; each names the picture.
Result<map::TopologicalMap> build_map(const std::vector<const TourSource*>& tours, const camera::CameraConfig& camera,
                                      const BuildOptions& options, const map::TopologicalMap* previous = nullptr,
                                      const ProgressSink& progress = {}, std::stop_token stop = {});

}  // namespace homeward::pipeline
