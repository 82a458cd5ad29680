// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "driving/driving_config.hpp"
#include "driving/driving_state.hpp"
#include "wire/link_messages.hpp"

namespace homeward::driving {

/// The probability that the robot states of being within `arrived_within_m` of its destination, as of the latest
/// picture of the drive. Nothing: it has no mission, has seen nothing yet, or homes to one view of which there is no
/// map.
std::optional<double> stated_arrival(const DrivingState& state, const DrivingConfig& config);

/// The place of the map that it is at by its own estimate, as of the latest picture of the drive. Nothing: it is not
/// sure enough to drive by it, or its camera is covered.
std::optional<wire::EstimateReport> stated_estimate(const DrivingState& state, const DrivingConfig& config);

/// The places that it may be at by its own estimate, most probable first, however unsure that is. None where its camera
/// is covered.
std::vector<wire::EstimateReport> stated_places(const DrivingState& state);

/// The question that waits for an answer. Nothing: it asks nothing, or somebody has answered. `now_ms`: by the sensors'
/// clock, as of `step`.
std::optional<wire::QuestionReport> open_question(const DrivingState& state, const DrivingConfig& config,
                                                  Milliseconds now_ms);

/// How far along its way it is: the number of the view homed to, or of the arc of a path that was taught.
std::int64_t stated_index(const DrivingState& state);

}  // namespace homeward::driving
