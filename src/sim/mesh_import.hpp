// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "core/result.hpp"
#include "sim/scene.hpp"

namespace homeward::sim {

enum class MeshUp { kY, kZ };

/// A mesh in any format that assimp reads, from memory, with its embedded textures. `extension` ("glb", "obj", ...)
/// tells the format, `where` names the mesh in errors. With kY the world's (x, y, z) is the mesh's (x, -z, y). Errors:
/// kUnsupportedFormat (assimp cannot read it), kEmptyInput (no triangle).
Result<Scene> import_mesh(std::span<const std::uint8_t> bytes, const std::string& extension, MeshUp up,
                          const std::string& where);

}  // namespace homeward::sim
