// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.hpp"
#include "sim/renderer.hpp"
#include "sim/scene.hpp"

namespace homeward::scenario {

/// A world by its name: "house:SEED", "narrow_house:SEED", "offices:SEED", "wards:SEED", "laboratory:SEED",
/// "circuit:SEED" or "course:SEED" is generated, anything else is a world.json (or of the folder that holds it). Floor
/// grids that the file does not bring are computed from the mesh. Errors: kNotFound, kInvalidInput, kUnsupportedFormat,
/// each naming file and field.
Result<sim::World> load_world(const std::string& name);

/// Takes what a light gives from the user's cache folder ($XDG_CACHE_HOME/homeward or ~/.cache/homeward), or
/// computes it (seconds) and keeps it there. A cache that cannot be read or written is only slower.
void prepare_light(sim::LitWorld& world, const sim::Light& light);

/// "day", "night", "half" or "daylight:LEVEL", LEVEL from 0 (as night) to 1 (as day). Errors: kInvalidInput, which
/// names what was asked for.
Result<sim::Light> light_named(const std::string& name);

}  // namespace homeward::scenario
