// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/pose2.hpp"

namespace homeward::linemodel {

/// One guess of where a robot is.
struct Particle {
  Pose2 pose;
  double weight = 1.0;  // of a set they sum to 1
};

}  // namespace homeward::linemodel
