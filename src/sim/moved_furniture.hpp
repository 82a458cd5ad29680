// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "core/result.hpp"
#include "sim/scene.hpp"

namespace homeward::sim {

struct MovedFurniture {
  World world;
  int moved = 0;  // pieces in all
};

/// The world with `in_each_room` pieces of furniture of every room pushed 0.5 to 1.5 m to a free spot of the same room,
/// fewer where no more can be moved. No piece comes within 0.9 m of a room's point, into another piece or into what is
/// built in, and all rooms' points stay joined by floor as wide as before for a disc of `robot_radius_m` with up to
/// 0.15 m to spare. Same seed, same world. Errors: kInvalidInput for a world that does not know its furniture.
Result<MovedFurniture> move_furniture(const World& world, int in_each_room, double robot_radius_m, std::uint64_t seed);

}  // namespace homeward::sim
