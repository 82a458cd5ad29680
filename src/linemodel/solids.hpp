// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "linemodel/welded_mesh.hpp"

namespace homeward::linemodel {

/// Of each triangle, whether it is of the skin of a solid body: triangles joined by their corners that close (each edge
/// is gone along as often one way as the other), with their fronts outside, and too narrow to be a room (2.5 m). Who
/// sees the back of such a triangle is inside the body.
std::vector<bool> skins_of_solids(const WeldedMesh& mesh);

}  // namespace homeward::linemodel
