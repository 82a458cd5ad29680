// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "driving/driving_config.hpp"
#include "driving/driving_state.hpp"
#include "driving/inputs.hpp"
#include "driving/outputs.hpp"

namespace homeward::driving {

/// Takes the server's messages into the state: newer missions and orders to explore, permits, stops. What is older than
/// what was obeyed already is passed over. Missions are refused while the rider steers, and when they waited for a loop
/// that was held up; explorations also where the inputs say why not.
void obey(DrivingState& state, const Inputs& inputs, bool rider_steers, const DrivingConfig& config,
          Milliseconds now_ms, Outputs& outputs);

}  // namespace homeward::driving
