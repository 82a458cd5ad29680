// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "core/pose2.hpp"
#include "core/result.hpp"
#include "driving/path_sight.hpp"
#include "features/appearance.hpp"
#include "pipeline/eye.hpp"

namespace homeward::scenario {

/// A picture of the tour as a heading-only repeat keeps it.
struct ShownPicture {
  features::Appearance appearance;
  Pose2 odometry;
};

/// What a path that was taught is measured against: how far along it the robot is says odometry alone, its heading is
/// corrected by how far features are shifted sideways against the picture that was taken there, and that it is beside
/// the way is not known (Krajnik, Majer, Halodova & Vintr, Navigation without localisation, IROS 2018). It gives the
/// same as driving::PathWatch, so that all else is driven alike.
class HeadingOnly {
 public:
  /// `shown`: at least two, in order. `eye` has to outlive it. `begin` and `end`: numbers of those where the robot
  /// stands and where it is to stop.
  HeadingOnly(std::vector<ShownPicture> shown, const pipeline::Eye& eye, std::size_t begin, std::size_t end);

  /// Errors: those of Eye::look.
  Result<driving::PathSight> see(const Image& picture, driving::Milliseconds taken_ms, const Pose2& odometry);

 private:
  void go_on(const Pose2& odometry);

  std::vector<ShownPicture> shown_;
  const pipeline::Eye& eye_;
  std::size_t end_;
  std::size_t here_;             // the picture of the tour that was taken about here
  Pose2 taught_from_robot_;      // in odometry's frame of the tour
  std::optional<Pose2> latest_;  // of the robot's own odometry
};

}  // namespace homeward::scenario
