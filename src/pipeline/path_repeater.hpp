// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "camera/camera_config.hpp"
#include "core/image.hpp"
#include "core/result.hpp"
#include "map/taught_path.hpp"
#include "map/topological_map.hpp"
#include "repeat/repeat_config.hpp"
#include "repeat/repeater.hpp"

namespace homeward::pipeline {

/// Repeats the path of a map (teach_path.hpp) picture by picture: key images are decoded as the way comes near them.
/// A value; copies are independent and share the map.
class PathRepeater {
 public:
  /// `camera`: what the pictures to come are taken with; it has to be the map's own, or one just like it.
  /// Errors: kInvalidInput (a map that was not taught as a path, another camera, and those of Repeater::create),
  /// and of decoding, which name the key image.
  static Result<PathRepeater> create(std::shared_ptr<const map::TopologicalMap> map, const camera::CameraConfig& camera,
                                     const repeat::RepeatConfig& config = {});

  /// See Repeater::begin.
  Status begin(int arc) { return repeater_.begin(arc); }
  /// What the next picture says. Errors: kWrongImageSize, those of ImagePyramid::build, kNotFound; nothing is changed.
  Result<repeat::Repeated> step(const Image& picture);

  [[nodiscard]] const repeat::Repeater& repeater() const { return repeater_; }
  [[nodiscard]] const map::MapPath& path() const { return *map_->path; }

 private:
  PathRepeater(std::shared_ptr<const map::TopologicalMap> map, repeat::Repeater repeater)
      : map_(std::move(map)), repeater_(std::move(repeater)) {}

  std::shared_ptr<const map::TopologicalMap> map_;
  repeat::Repeater repeater_;
};

}  // namespace homeward::pipeline
