// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "camera/camera_config.hpp"
#include "core/ids.hpp"
#include "core/image.hpp"
#include "core/pose2.hpp"
#include "core/result.hpp"
#include "driving/milliseconds.hpp"
#include "driving/path_sight.hpp"
#include "map/topological_map.hpp"
#include "pipeline/path_repeater.hpp"
#include "pipeline/taught_way.hpp"

namespace homeward::driving {

/// Holds a robot's pictures against a path that was taught: what the driving step is told of it. It takes some 10 ms a
/// picture, and is not for the thread that drives. A value.
class PathWatch {
 public:
  /// `end`: the picture of the tour where the robot is to stop, once it has come by there `rounds` times. It may begin
  /// anywhere on the path.
  /// Errors: those of PathRepeater::create and TaughtWay::create.
  static Result<PathWatch> create(std::shared_ptr<const map::TopologicalMap> map, const camera::CameraConfig& camera,
                                  const ImageId& end, std::int64_t rounds, const repeat::RepeatConfig& config = {});

  /// `odometry`: where it was taken. Errors: those of PathRepeater::step; nothing is changed.
  Result<PathSight> see(const Image& picture, Milliseconds taken_ms, const Pose2& odometry);

  [[nodiscard]] const pipeline::PathRepeater& repeater() const { return repeater_; }

 private:
  PathWatch(pipeline::PathRepeater repeater, pipeline::TaughtWay way, std::int64_t rounds)
      : repeater_(std::move(repeater)), way_(std::move(way)), rounds_left_(rounds), was_away_(rounds == 0) {}

  pipeline::PathRepeater repeater_;
  pipeline::TaughtWay way_;
  std::int64_t rounds_left_;
  std::optional<int> latest_;  // picture of the tour that it was near to
  bool was_away_;              // from where it is to stop, since a round was counted
};

}  // namespace homeward::driving
