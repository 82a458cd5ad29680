// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "driving/driving_config.hpp"
#include "driving/driving_state.hpp"

namespace homeward::driving {

/// How fast the robot may drive at most where it is, m/s: by its mission and its body, and slowly on a way that no tour
/// drove. Precondition: there is a mission.
double speed_limit_mps(const DrivingState& state, const DrivingConfig& config);

}  // namespace homeward::driving
