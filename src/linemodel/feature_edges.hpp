// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "linemodel/plan.hpp"

namespace homeward::linemodel {

struct FeatureEdgesConfig {
  float weld_m = 0.001F;       // corners as near as that are one
  float crease_rad = 0.6109F;  // 35 degrees: surfaces that bend by less go on; a tube of twelve sides is round
  float min_length_m = 0.25F;  // shorter lines are left out
  float same_line_m = 0.03F;   // a line that lies that near along a longer one is left out
  float open_m = 0.5F;         // how far one has to be able to look from an edge
};

/// The lines that a drawn plan shows of a mesh, metres: where its surfaces end, bend or cross, in straight lines as
/// long as they go on. The diagonals of flat faces, the seams between faces that go on as one, and edges that no one
/// can look at from half a metre away because they lie inside walls or furniture are left out (ours: rays into each of
/// the wedges of space around an edge). In no order that matters; the same mesh gives the same lines.
std::vector<PlanLine> feature_edges(const raycast::Vertices& vertices_m, const raycast::Triangles& triangles,
                                    const FeatureEdgesConfig& config = {});

/// A plan of a mesh: its feature edges, and its triangles as they are.
Plan plan_of_mesh(raycast::Vertices vertices_m, raycast::Triangles triangles, const FeatureEdgesConfig& config = {});

}  // namespace homeward::linemodel
