// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "linemodel/welded_mesh.hpp"

namespace homeward::linemodel {

/// A piece of an edge, from point to point with no point between, and the surfaces that end or bend there.
struct RimEdge {
  int from = 0;  // indices of the mesh's points, from < to
  int to = 0;
  std::vector<Eigen::Vector3f> faces;  // unit vectors, at right angles to the edge: where each surface lies from it
};

/// The edges of a mesh at which its surface ends or bends by more than `crease_rad`. Where edges lie on one another
/// without having all their points in common (T-junctions, panels beside panels), they are cut at one another's points
/// and taken together, so that what only seems to end there does not.
std::vector<RimEdge> rim_edges(const WeldedMesh& mesh, float crease_rad);

}  // namespace homeward::linemodel
