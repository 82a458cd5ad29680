// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "driving/follow_config.hpp"
#include "driving/follow_state.hpp"
#include "driving/visual_path.hpp"

namespace homeward::driving {

/// One view of the map and what the latest picture says of it.
struct ComparedView {
  int view = 0;  // of the path, then of those nearby
  ViewSighting sighting;
  bool at_start = false;  // of the path, of a robot that knows nothing yet
};

/// Compares a picture with the views that it may be of: those near to where the robot may be, those of the path that
/// come next, and the few of all that look most like it.
/// Ours: Goedemé 2007 §7 compares with the next view of the path alone: docs/experiments/one_estimate_while_driving.md.
std::vector<ComparedView> compare_views(const FollowState& state, const VisualPath& path,
                                        const features::Appearance& seen, const FollowConfig& config,
                                        std::uint64_t seed);

}  // namespace homeward::driving
