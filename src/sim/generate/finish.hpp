// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/generate/shell.hpp"
#include "sim/scene.hpp"

namespace homeward::sim {

/// Computes the floor grids of a generated world, gives each space's room its point (the roomiest free spot near the
/// middle) and its outline, and starts in the first of them. False when a room cannot be reached.
bool finish_world(World& world, const std::vector<Space>& spaces);

/// Says of each piece of furniture in which of the world's rooms its middle lies.
void name_rooms_of(World& world);

}  // namespace homeward::sim
