// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "camera/camera_config.hpp"
#include "core/result.hpp"
#include "core/tour.hpp"
#include "features/appearance.hpp"
#include "map/topological_map.hpp"
#include "map/tour_warning.hpp"
#include "mapping/map_builder.hpp"
#include "mapping/pair_table.hpp"

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

/// What was seen and compared on the way to a map. Row i of all members belongs to image i of the map.
struct BuildNotes {
  std::vector<int> tour_of;
  std::vector<features::Appearance> appearances;
  mapping::PairTable pairs{0};
  mapping::MappingNotes mapping;
  std::vector<Error> skipped;              // pictures that the map does without, and why; each names its picture
  std::vector<map::TourWarning> warnings;  // what is odd about the tours
};

/// A map with all that a report on it tells.
struct BuiltMap {
  map::TopologicalMap map;
  BuildNotes notes;
};

/// Builds the map of one or more tours with the same camera. Same input, same map, whatever the number of threads.
/// `previous`: a map whose ids, labels, destinations and edits outlive the rebuild, or null.
/// Pictures that cannot be read are left out and noted.
/// Errors: kEmptyInput, kTooFewImages (under 3 that can be read), kTooFewFeatures (names the share of pictures without
/// texture), kWrongImageSize, kCancelled, that of TourSource::read when no picture can be read; each names a picture.
/// The order of the steps: Goedemé 2006 §3.
Result<map::TopologicalMap> build_map(const std::vector<const TourSource*>& tours, const camera::CameraConfig& camera,
                                      const BuildOptions& options, const map::TopologicalMap* previous = nullptr,
                                      const ProgressSink& progress = {}, const std::stop_token& stop = {});

/// The same, with what was found out on the way.
Result<BuiltMap> build_noted_map(const std::vector<const TourSource*>& tours, const camera::CameraConfig& camera,
                                 const BuildOptions& options, const map::TopologicalMap* previous = nullptr,
                                 const ProgressSink& progress = {}, const std::stop_token& stop = {});

}  // namespace homeward::pipeline
