// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "driving/follow_config.hpp"
#include "driving/follow_state.hpp"
#include "driving/visual_path.hpp"

namespace homeward::driving {

/// The homing to the view homed to, begun anew when that is another one.
homing::VisualHoming& homing_of(FollowState& state, const FollowConfig& config);

/// A homing that knows nothing yet.
homing::VisualHoming new_homing(const FollowConfig& config);

/// Whether an answer is clear by itself.
bool is_sure(const homing::HomeVector& vector, const FollowConfig& config);

/// Whether an answer is worth taking in. Right at the view its bearing says nothing any more, and where it is does.
bool is_believed(const Result<homing::TargetSeen>& answer, const FollowConfig& config);

/// Takes in where the view homed to is seen; false where that says nothing or contradicts what is known.
bool take_in(FollowState& state, const Result<homing::TargetSeen>& answer, const FollowConfig& config,
             FollowResult& result);

/// How far the view homed to is by what is known of it; `mapped`: not by its own pictures alone.
std::optional<homing::DistancePrior> distance_known(const FollowState& state, bool mapped);

/// Whether the view homed to, the destination's own, is reached.
/// Ours: Goedemé 2007 §7.2.4 leaves the end to the locomotion system.
bool is_reached(FollowState& state, const VisualPath& path, const FollowConfig& config, const FollowResult& result);

}  // namespace homeward::driving
