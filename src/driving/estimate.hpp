// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "driving/driving_config.hpp"
#include "driving/driving_state.hpp"
#include "driving/inputs.hpp"

namespace homeward::driving {

/// Takes the sweep that was sensed and the picture into the estimate of where the robot is: what a sweep shows on ways
/// that tours drove, what is recognised in the picture, where the view homed to lies. Notices that the robot was
/// lifted, which ends a mission, and keeps the estimate for the next one. `now_ms`: by the machine's clock.
void estimate(DrivingState& state, const Inputs& inputs, const DrivingConfig& config, Milliseconds now_ms,
              Milliseconds sensors_ms);

}  // namespace homeward::driving
