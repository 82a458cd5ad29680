// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "driving/driving_config.hpp"
#include "driving/driving_state.hpp"
#include "driving/outputs.hpp"
#include "wire/link_messages.hpp"

namespace homeward::driving {

/// Takes the server's messages into the state: newer missions, permits, stops. What is older than what was obeyed
/// already is passed over. Missions are refused while the rider steers, and when they waited for a loop that was held
/// up.
void obey(DrivingState& state, const std::vector<wire::ServerMessage>& messages, bool rider_steers,
          const DrivingConfig& config, Milliseconds now_ms, Outputs& outputs);

}  // namespace homeward::driving
