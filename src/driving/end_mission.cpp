// SPDX-License-Identifier: Apache-2.0
#include "driving/end_mission.hpp"

#include <utility>

namespace homeward::driving {

void end_mission(DrivingState& state, wire::DriveState how, std::optional<wire::Reason> reason) {
  state.drive = how;
  state.reason = std::move(reason);
  state.docking = false;
  withdraw(state.asking);
}

}  // namespace homeward::driving
