// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "linemodel/rim_edges.hpp"
#include "linemodel/welded_mesh.hpp"

namespace homeward::linemodel {

/// The lines in which surfaces pass through one another, such as a wall that goes on above a ceiling: there is a corner
/// to be seen without an edge of the mesh. Of triangles with a side of half a metre or more; surfaces that only touch
/// are left out, as are those that cross at less than `crease_rad`. The ends of the lines are added to the mesh's
/// points. Triangles are intersected as by Moller (1997).
std::vector<RimEdge> crossing_edges(WeldedMesh& mesh, float crease_rad);

}  // namespace homeward::linemodel
