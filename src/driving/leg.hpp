// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/ids.hpp"
#include "driving/drive_towards.hpp"
#include "driving/driving_config.hpp"
#include "driving/driving_state.hpp"
#include "driving/inputs.hpp"
#include "wire/link_messages.hpp"

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

/// An order to explore.
struct Exploration {
  MissionId id;
  wire::Order order;
  std::int64_t valid_for_ms = 0;  // of the first permit, from now on
  double speed_limit_mps = 0.0;
};

/// The robot explores from now on, as long as permits for it come: it drives to the legs that the inputs bring, and
/// stands where they bring none. Whatever ends a mission ends it, too: silence of link, camera or scanner, the rider's
/// hand, a stop. False: it is refused, as a mission would be: something newer was obeyed already, the rider steers, or
/// the order waited while no step was made.
bool begin_exploration(DrivingState& state, const Exploration& exploration, const Inputs& inputs,
                       const DrivingConfig& config, Milliseconds now_ms, Milliseconds sensors_ms);

/// Notes how the leg gets on. Precondition: it explores.
void judge_leg(DrivingState& state, const Inputs& inputs, Milliseconds sensors_ms, const LegConfig& leg = {});

/// The motion towards the leg's goal; it makes room for somebody on the way. Precondition: it explores.
Motion leg_motion(DrivingState& state, const Situation& now);

}  // namespace homeward::driving
