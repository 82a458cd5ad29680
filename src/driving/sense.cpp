// SPDX-License-Identifier: Apache-2.0
#include "driving/sense.hpp"

#include <algorithm>

#include "driving/scan.hpp"

namespace homeward::driving {
namespace {

/// Only a body that is not round goes so near to things that the noise of single sweeps matters; arcs of ultrasound are
/// no surfaces that several sweeps could agree on.
bool steadies(const Body& body) { return !is_round(body.outline) && !body.vague_ranges; }

void steady(DrivingState& state, const Inputs& inputs, const DrivingConfig& config) {
  if (state.scan && steadies(config.body))
    state.sweeps.observe(state.scan->scan, inputs.odometry, state.scan->taken_ms);
}

void take_sweep(DrivingState& state, const Inputs& inputs, const DrivingConfig& config, Milliseconds sensors_ms) {
  state.scan = inputs.scan;
  // A clock that is ahead must not hide a scanner that falls silent.
  state.scan->taken_ms = std::min(state.scan->taken_ms, sensors_ms);
  // The arcs of ultrasound come and go by themselves.
  if (!config.body.vague_ranges) watch(state.moving_obstacle, state.scan->scan, inputs.odometry, sensors_ms);
  steady(state, inputs, config);
}

std::optional<double> nearest_m(const std::vector<Eigen::Vector2d>& points_m) {
  std::optional<double> least_m;
  for (const Eigen::Vector2d& point : points_m) least_m = std::min(least_m.value_or(1e9), point.norm());
  return least_m;
}

}  // namespace

void begin_sensing(DrivingState& state, const Inputs& inputs, const DrivingConfig& config) {
  state.turning = {};
  state.sweeps = {};
  steady(state, inputs, config);
}

std::vector<Eigen::Vector2d> sense(DrivingState& state, const Inputs& inputs, const DrivingConfig& config,
                                   Milliseconds sensors_ms) {
  state.turning.observe(inputs.odometry.theta_rad, sensors_ms);
  remember_trail(state.give_way, inputs.odometry);
  if (inputs.scan) take_sweep(state, inputs, config, sensors_ms);
  std::vector<Eigen::Vector2d> points_m;
  if (state.scan) points_m = steadies(config.body) ? state.sweeps.points_m() : hit_points(state.scan->scan);
  state.min_range_m = nearest_m(points_m);
  return points_m;
}

}  // namespace homeward::driving
