// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "driving/driving_config.hpp"
#include "driving/driving_state.hpp"
#include "driving/inputs.hpp"

namespace homeward::driving {

/// The motion that a robot under way wants by what it knows: turning to the destination's heading, standing while it
/// asks, looking around where it does not know where it is, making room for somebody, or driving to the view homed to.
/// It is no promise that the motion is safe or permitted. Ends the mission once the heading is taken.
/// Precondition: there is a mission, and it drives.
Motion choose_motion(DrivingState& state, const Inputs& inputs, const DrivingConfig& config,
                     const std::vector<Eigen::Vector2d>& points_m, Milliseconds sensors_ms);

}  // namespace homeward::driving
