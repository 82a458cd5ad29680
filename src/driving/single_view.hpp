// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "driving/follow_config.hpp"
#include "driving/follow_state.hpp"
#include "driving/visual_path.hpp"

namespace homeward::driving {

/// One picture further to a view of which nothing but its own picture says anything: a path that is `alone`.
/// The robot was moved by odometry already.
/// Goedemé 2007 §7; from far off it is ours: docs/experiments/homing_to_one_view.md.
FollowResult home_to_single_view(FollowState& state, const VisualPath& path, const features::Appearance& seen,
                                 const tracking::TrackingFrame& frame, const FollowConfig& config, std::uint64_t seed);

}  // namespace homeward::driving
