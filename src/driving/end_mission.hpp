// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "driving/driving_state.hpp"
#include "wire/link_messages.hpp"

namespace homeward::driving {

/// Ends the mission: the robot stands until a newer one comes.
void end_mission(DrivingState& state, wire::DriveState how, std::optional<wire::Reason> reason);

}  // namespace homeward::driving
