// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace homeward::mapping {

struct DoorwayConfig {
  double narrowest_m = 0.6;
  double widest_m = 1.6;
  double wall_m = 0.35;        // so far beside the gap stands what the gap is in,
  double least_wall = 0.6;     // so much of that at least, on each side
  double opens_after_m = 0.4;  // so far before and behind the gap there is more room,
  double opens_by_m = 0.8;     // by so much
  double thickness_m = 0.1;    // half of what counts as one wall
};

/// A gap in a wall, wide enough to go through.
struct Doorway {
  Eigen::Vector2d middle_m;
  Eigen::Vector2d normal;  // of the wall, either way
  double width_m = 0.0;
};

/// The doorways that straight ways between the spots lead through, the surest first. `points_m`: what sweeps hit
/// around the spots, in one frame with them. A gap counts where walls go on to both sides of it in its own line, and
/// where there is more room before it and behind it: a corridor is none. Ours.
std::vector<Doorway> doorways_between(std::span<const Eigen::Vector2d> points_m,
                                      std::span<const Eigen::Vector2d> spots_m, const DoorwayConfig& config = {});

}  // namespace homeward::mapping
