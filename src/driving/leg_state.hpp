// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/pose2.hpp"

namespace homeward::driving {

/// How a robot gets on with the legs that it drives.
struct LegState {
  bool begun = false;
  Pose2 got_on_at;                    // where it last got on, odometry's frame,
  std::int64_t got_on_ms = 0;         // and when, by the sensors' clock
  Pose2 spot;                         // about where it has been
  std::int64_t at_spot_since_ms = 0;  // since then
  bool blocked = false;               // it does not get on: another leg is wanted
};

}  // namespace homeward::driving
