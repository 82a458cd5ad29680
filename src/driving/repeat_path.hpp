// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "driving/drive_towards.hpp"
#include "driving/driving_state.hpp"
#include "driving/inputs.hpp"

namespace homeward::driving {

/// As a mission begins.
void begin_repeat(RepeatState& repeat, const Pose2& odometry, Milliseconds sensors_ms);

/// Takes what a picture says of the path, notes whether it gets on, and ends the mission where it has arrived, is lost
/// or does not get on. Precondition: it repeats.
void judge_repeat(DrivingState& state, const Inputs& inputs, const DrivingConfig& config, Milliseconds sensors_ms);

/// The motion along the path: to a point of the way that was taught a little ahead, and no farther than where that
/// turned on the spot, which it then does, too; slower in bends, in doubt, and on to the end. Between two pictures, and
/// for `blind_m` after the last one that was known, odometry carries it on. Ours. Where the way is not known in metres,
/// or the configuration wants it, Segvic et al. 2007 (§2.3): it steers so that features move to where the next key
/// image has them, and cuts corners. It makes room for somebody on the way. Precondition: it repeats.
Motion repeat_motion(DrivingState& state, const Situation& now);

}  // namespace homeward::driving
