// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "core/pose2.hpp"
#include "exploration/pose_graph.hpp"

namespace homeward::exploration {

/// Poses by the steps from one to the next and by the loops that are believed.
struct SettledLoops {
  std::vector<Pose2> poses;
  std::vector<std::uint8_t> believed;  // one for each loop
};

/// Settles poses (from where they are) by `steps` and by the loops that are believed, and believes no loop any more
/// that the others contradict by eight spreads. Whichever was believed first pulls all to itself, and the right ones
/// that come after it are contradicted: where three or more of the latest loops (`since`: by the key view that was
/// known again) are not believed, all of them are weighed anew at once, and what fits the most of steps and loops
/// holds. From loose to tight, so that no loop begins with an advantage: Yang, Antonante, Tzoumas & Carlone, Graduated
/// non-convexity for robust spatial perception (2020), with Cauchy's weights. Same input, same answer.
SettledLoops settle_loops(std::vector<Pose2> poses, const std::vector<PoseLink>& steps,
                          const std::vector<PoseLink>& loops, std::vector<std::uint8_t> believed, int since);

}  // namespace homeward::exploration
