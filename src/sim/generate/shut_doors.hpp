// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/result.hpp"
#include "sim/scene.hpp"

namespace homeward::sim {

struct ShutDoors {
  World world;
  int shut = 0;  // doors
};

/// The world with some of its doors shut: each one with the probability `share`, [0, 1]. A leaf that stood open beside
/// its doorway is in it then. What can be driven is what can still be got to from the start. Same seed, same doors.
/// Errors: kInvalidInput for a world that does not know its doors.
Result<ShutDoors> shut_doors(const World& world, double share, std::uint64_t seed);

}  // namespace homeward::sim
