// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "raycast/ray_scene.hpp"
#include "sim/scene.hpp"

namespace homeward::sim {

/// A scene ready for ray casting; the panes of its windows are marked as such.
raycast::RayScene rays_of(const Scene& scene);

}  // namespace homeward::sim
