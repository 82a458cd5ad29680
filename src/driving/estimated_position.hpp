// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "core/ids.hpp"
#include "driving/follow_config.hpp"
#include "driving/follow_state.hpp"
#include "driving/visual_path.hpp"

namespace homeward::driving {

/// Probability that the robot is where the estimate says; 1 of one view alone, which has no map to be on.
double position_probability(const FollowState& state, const VisualPath& path);

/// The probability of where the robot is from which on it drives along its path.
double drives_above(const FollowState& state, const FollowConfig& config);

/// Probability that the robot is within `arrived_within_m` of the destination's view; 1 of one view alone.
/// Ours: docs/experiments/stated_arrival.md.
double arrival_probability(const FollowState& state, const VisualPath& path, const FollowConfig& config);

/// Whether that is enough to say that it has arrived: `arrived_probability`, and less where no map says where the views
/// lie. While the server's belief is lost, which is of the whole map, only if somebody says so too.
bool is_certain_of_arrival(const FollowState& state, const VisualPath& path, const FollowConfig& config,
                           bool somebody_says_so = false);

/// Whether one that was certain still is; a little less is enough, as the last pictures waver, and a
/// belief that gets lost while it turns takes nothing back.
bool stays_certain_of_arrival(const FollowState& state, const VisualPath& path, const FollowConfig& config);

/// Share of a view's features that must be recognised where pictures alone tell of it. Rendered houses: 0.13 and more
/// of its features are recognised from half a metre, by night too, and 0.03 (median) from five metres.
inline constexpr double kLeastShareAlone = 0.1;

/// The share of the destination's features that must have been recognised for it to be right here, whatever the
/// geometry says: more where no map says how far it is, less where the estimate is certain that the robot is there.
double share_when_here(const FollowState& state, const VisualPath& path, const FollowConfig& config);

/// The place of the map that the robot is at by the estimate; nothing where that is not sure enough to drive by.
std::optional<PlaceId> estimated_place(const FollowState& state, const VisualPath& path, const FollowConfig& config);

/// A place of the map that the robot may be at.
struct PossiblePlace {
  PlaceId place;
  double probability = 0.0;
};

/// The places that the robot may be at by the estimate, however unsure that is: most probable first, four at most.
std::vector<PossiblePlace> possible_places(const FollowState& state, const VisualPath& path);

/// How far from its path the robot is by the estimate; nothing where that is not sure enough to drive by.
std::optional<double> off_path_m(const FollowState& state, const VisualPath& path, const FollowConfig& config);

/// How far the estimate is from the place that the server's belief names; infinity where the mission tells of no such
/// place, nothing where either is not sure.
std::optional<double> off_belief_m(const FollowState& state, const VisualPath& path, const FollowConfig& config);

}  // namespace homeward::driving
