// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "core/pose2.hpp"
#include "driving/milliseconds.hpp"
#include "driving/path_sight.hpp"

namespace homeward::driving {

/// How a robot gets on with a path that was taught.
struct RepeatState {
  std::optional<PathSight> known;        // the last that was not lost
  std::optional<Milliseconds> heard_ms;  // when a picture was held against the path last, lost or not
  std::optional<Milliseconds> known_ms;  // the same of those that were not lost
  Milliseconds begun_ms = 0;
  Pose2 odometry;                                // of the last step
  std::optional<Milliseconds> odometry_from_ms;  // it has begun anew then
  Pose2 got_on_at;                               // where it last got on, odometry's frame,
  Milliseconds got_on_ms = 0;
  Pose2 spot;                         // about where it has been,
  Milliseconds at_spot_since_ms = 0;  // since then
  bool at_end = false;                // it is where it is to stop; what is left is the heading
};

}  // namespace homeward::driving
