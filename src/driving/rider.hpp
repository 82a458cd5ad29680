// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "driving/driving_config.hpp"
#include "driving/inputs.hpp"

namespace homeward::driving {

/// Whether the rider's hand is on the joystick now. A reading that is too old, or of a time to come, is of no hand.
bool rider_steers(const Inputs& inputs, const DrivingConfig& config, Milliseconds sensors_ms);

/// The motion that the rider wants, made safe by a fresh sweep while the body turns by `turning_radps`. Without one the
/// rider still moves, but creeps only: a person who sits in a doorway is not left there because a scanner broke.
/// Ours, because who sits in the chair goes before any program.
Motion rider_motion(const JoystickReading& hand, const std::optional<SeenScan>& scan,
                    const std::vector<Eigen::Vector2d>& points_m, double turning_radps, const DrivingConfig& config,
                    Milliseconds sensors_ms);

}  // namespace homeward::driving
