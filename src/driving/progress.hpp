// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "driving/driving_config.hpp"
#include "driving/driving_state.hpp"

namespace homeward::driving {

/// Ends a mission that has arrived, that makes no way any more, or that does not know where it is; beside the
/// destination and not certain of it, asks people. `now_ms`: by the sensors' clock.
/// Ours: the papers do not say when a drive has failed.
void judge_progress(DrivingState& state, const DrivingConfig& config, Milliseconds now_ms);

}  // namespace homeward::driving
