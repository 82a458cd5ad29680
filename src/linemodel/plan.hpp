// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "raycast/ray_scene.hpp"

namespace homeward::linemodel {

/// A straight edge of a building or of what stands in it.
struct PlanLine {
  Eigen::Vector3f from_m = Eigen::Vector3f::Zero();
  Eigen::Vector3f to_m = Eigen::Vector3f::Zero();
};

/// A drawn plan of a building: its edges, which a camera may see, and its surfaces, which hide edges from it. Frame of
/// the plan: metres, z up, floor at z = 0. A plan of lines alone has no surfaces; nothing is hidden in it then.
struct Plan {
  std::vector<PlanLine> lines;
  raycast::Vertices vertices_m{0, 3};
  raycast::Triangles triangles{0, 3};
};

}  // namespace homeward::linemodel
