// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "camera/camera_config.hpp"
#include "core/result.hpp"
#include "core/tour.hpp"
#include "map/taught_path.hpp"
#include "map/topological_map.hpp"
#include "pipeline/build_map.hpp"
#include "repeat/teach_config.hpp"

namespace homeward::pipeline {

/// The bytes of a tour's picture as it was taken, JPEG or PNG: what a map keeps of a key image. Errors: of reading.
using PictureBytes = std::function<Result<std::vector<std::uint8_t>>(std::size_t index)>;

/// A map that was taught as a path: its `path` is never null.
struct PathMap {
  map::TopologicalMap map;
  std::vector<Error> skipped;  // pictures that it does without, and why; each names its picture
};

/// Teaches a path by one tour of an ordinary camera (repeat/teach.hpp) and makes a map of it, for all that knows maps:
/// each key image is the prototype of a place, which has the pictures that were shown nearest to it for members; each
/// arc is an edge in both directions, and so is the one that closes a path which comes round; marks of the tour are
/// destinations. Pictures that cannot be read are left out. Errors: kCancelled, kEmptyInput, kInvalidInput (a mark
/// without its picture, and those of Teacher::create), kWrongImageSize, kTooFewImages, kTooLittleSupport,
/// kTooFewFeatures (a key image in which a map sees nothing), and those of the tour and of `bytes`; each names a
/// picture where it is about one.
Result<PathMap> teach_path(const TourSource& tour, const camera::CameraConfig& camera, const std::string& name,
                           const repeat::TeachConfig& config, const PictureBytes& bytes,
                           const ProgressSink& progress = {}, const std::stop_token& stop = {});

}  // namespace homeward::pipeline
