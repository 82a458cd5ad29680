// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sim/scene.hpp"

namespace homeward::sim {

/// The same surface in triangles whose edges are at most `max_edge_m` long (longest edge halved again and again).
Scene tessellate(const Scene& scene, float max_edge_m);

}  // namespace homeward::sim
