// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "driving/driving_config.hpp"
#include "driving/driving_state.hpp"
#include "driving/inputs.hpp"

namespace homeward::driving {

/// Why the robot must not drive any more, for people: link, permit, pictures or sweeps are not fresh. Nothing: it may.
std::optional<wire::ReasonCode> reason_to_stop(const DrivingState& state, const Inputs& inputs,
                                               const DrivingConfig& config, Milliseconds now_ms,
                                               Milliseconds sensors_ms);

/// What is left of a motion that was chosen: within the speed limit, slower the longer something has been silent, not
/// backwards where no sweep shows what is behind, and safe before what stands there (`made_safe`).
/// Precondition: there is a mission, and nothing is a reason to stop.
Motion permitted_motion(Motion wanted, const DrivingState& state, const DrivingConfig& config,
                        const std::vector<Eigen::Vector2d>& points_m, Milliseconds now_ms, Milliseconds sensors_ms);

}  // namespace homeward::driving
