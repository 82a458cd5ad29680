// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "driving/driving_config.hpp"
#include "driving/driving_state.hpp"
#include "driving/inputs.hpp"
#include "driving/milliseconds.hpp"
#include "driving/outputs.hpp"

namespace homeward::driving {

/// One step of driving: no clock, thread, socket or device. Same state, inputs and time, same result.
/// The longer no message, picture or sweep has come, the slower it goes, so that braking ends `stands_within_ms` after
/// a silence begins although only `link_silence_ms`, `frame_silence_ms` or `scan_silence_ms` of it end the mission. It
/// drives only under a permit that is counted from its receipt on the robot's own clock, with link, pictures and sweeps
/// fresh; everything else is a stop, after which only a newer mission moves it again (docs/architecture.md). The
/// rider's joystick wins at any time: deflected, it ends the mission and the rider drives, with or without link and
/// permit, slowed by the range sensors as missions are; released, the robot stands. No mission drives backwards where
/// the sweeps do not show what is behind.
Outputs step(DrivingState& state, const Inputs& inputs, const DrivingConfig& config, Milliseconds now_ms);

}  // namespace homeward::driving
