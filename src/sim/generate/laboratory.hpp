// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/pose2.hpp"
#include "sim/lighting.hpp"
#include "sim/scene.hpp"

namespace homeward::sim {

/// What can change in the laboratory from one set of pictures to the next.
struct LaboratoryState {
  bool curtains_drawn = true;
  bool door_open = false;
  bool only_window_lamps = false;  // the two beside the windows burn, the four others do not
  double daylight = 0.0;           // light from outside through the windows; 5: a bright day
  std::uint64_t arrangement = 0;   // where the light furniture stands; another number, other places
};

/// One large room with two windows, six lamps, a door to a corridor, furniture along the walls and its middle free:
/// the kind of room of the picture database with which Ferdaus (2008) §3.5 compares measures. Walls, heavy furniture,
/// pictures on the walls and the looks of every piece depend on the seed alone.
World generate_laboratory(std::uint64_t seed, const LaboratoryState& state);

/// How a state of the laboratory is lit.
LightSettings laboratory_light(const LaboratoryState& state);

/// A point of the free middle: rows run along the room, `along_m` in 0..4.5 and `across_m` in 0..1.8 from their first
/// point.
Pose2 laboratory_point(double along_m, double across_m, double theta_rad);

}  // namespace homeward::sim
