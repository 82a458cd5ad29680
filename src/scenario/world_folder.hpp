// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.hpp"
#include "sim/renderer.hpp"
#include "sim/scene.hpp"

namespace homeward::scenario {

/// A world by its name: "house:SEED", "narrow_house:SEED", "offices:SEED", "wards:SEED", "laboratory:SEED" or
/// "circuit:SEED" is generated, anything else is a world.json (or of the folder that holds it). Floor grids that the
/// file does not bring are computed from the mesh. Errors: kNotFound, kInvalidInput, kUnsupportedFormat, each naming
/// file and field.
Result<sim::World> load_world(const std::string& name);

/// Takes the light of a preset from the user's cache folder ($XDG_CACHE_HOME/homeward or ~/.cache/homeward), or
/// computes it (seconds) and keeps it there. A cache that cannot be read or written is only slower.
void prepare_light(sim::LitWorld& world, sim::LightPreset preset);

/// "day", "night" or "half". Errors: kInvalidInput.
Result<sim::LightPreset> light_named(const std::string& name);

}  // namespace homeward::scenario
