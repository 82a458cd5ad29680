// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "driving/drive_towards.hpp"
#include "driving/driving_state.hpp"
#include "driving/inputs.hpp"

namespace homeward::driving {

/// When a leg counts as blocked.
struct LegConfig {
  double gets_on_m = 0.1;             // driven on by less,
  double gets_on_rad = 0.3;           // and turned by less, it does not get on:
  Milliseconds blocked_ms = 8000;     // after so long the leg is blocked,
  Milliseconds patience_ms = 30'000;  // after so long where somebody moves about the robot
  double spot_m = 0.6;                // and where it stays so near to one spot,
  Milliseconds at_spot_ms = 30'000;   // turning to and fro for so long
};

/// Notes how the leg gets on. Precondition: it explores.
void judge_leg(DrivingState& state, const Inputs& inputs, Milliseconds sensors_ms, const LegConfig& leg = {});

/// The motion towards the leg's goal; it makes room for somebody on the way. Precondition: it explores.
Motion leg_motion(DrivingState& state, const Situation& now);

}  // namespace homeward::driving
