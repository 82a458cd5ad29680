// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/pose2.hpp"
#include "driving/milliseconds.hpp"

namespace homeward::driving {

/// What a picture says of the path that is followed (pipeline/path_sight.hpp). While lost, all but the times means
/// nothing.
struct PathSight {
  Milliseconds taken_ms = 0;  // by the sensors' clock
  Pose2 odometry;             // when it was taken
  bool lost = true;
  int arc = 0;                   // of the path
  int tracked = 0;               // features
  double confidence = 0.0;       // 0 to 1
  double steering_rad = 0.0;     // by which to turn so that features move to where the next key image has them
  std::vector<Pose2> way;        // where the robot was when the path was shown, from about here on, in its frame at
                                 // `odometry`; empty: that is not known in metres
  bool ends = false;             // the last of the way is where it is to stop
  bool leads_elsewhere = false;  // from here the path does not lead to where it is to stop
};

}  // namespace homeward::driving
