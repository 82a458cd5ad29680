// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "driving/driving_config.hpp"
#include "driving/driving_state.hpp"
#include "driving/inputs.hpp"

namespace homeward::driving {

/// What stands about the robot and what it knows of itself, at one step.
struct Situation {
  const Inputs& inputs;
  const DrivingConfig& config;
  const std::vector<Eigen::Vector2d>& points_m;
  Milliseconds sensors_ms;
};

/// The motion to a point in the robot frame: straight or along an arc where the way is clear, else round what stands in
/// it.
Motion drive_towards(DrivingState& state, const Eigen::Vector2d& aim_m, double speed_mps, const Situation& now);

/// Back, or a moment's wait, for somebody who stands in the way and cannot get past; nothing where the robot goes on.
std::optional<Motion> give_way_motion(DrivingState& state, const Situation& now);

}  // namespace homeward::driving
