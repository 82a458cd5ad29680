// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "scenario/taught_world.hpp"
#include "sim/tour_path.hpp"
#include "truth.hpp"

namespace homeward {

/// A generated world, taught by one tour of all its rooms by day. An error ends the program.
inline scenario::TaughtWorld teach_all_rooms(const std::string& name, std::uint64_t seed) {
  wire::ScenarioFile scenario;
  scenario.world = name;
  scenario.seed = static_cast<std::int64_t>(seed);
  scenario.camera_model = "hyperbolic_mirror";
  auto world = or_die(scenario::world_of(scenario, "."));
  scenario.tour_rooms = sim::all_rooms(world);
  return or_die(scenario::teach(scenario, ".", std::move(world)));
}

}  // namespace homeward
