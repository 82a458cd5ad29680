// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "driving/driving_config.hpp"
#include "driving/driving_state.hpp"
#include "driving/inputs.hpp"

namespace homeward::driving {

/// A mission begins: what was known of how the body moves and of the sweeps together is of another drive.
void begin_sensing(DrivingState& state, const Inputs& inputs, const DrivingConfig& config);

/// Takes in odometry and the sweep: how the body turns, the trail that it leaves, whether something near it moves.
/// Gives what stands about the robot now: points in its frame, none before the first sweep.
std::vector<Eigen::Vector2d> sense(DrivingState& state, const Inputs& inputs, const DrivingConfig& config,
                                   Milliseconds sensors_ms);

}  // namespace homeward::driving
