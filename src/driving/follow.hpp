// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>

#include "core/pose2.hpp"
#include "driving/follow_config.hpp"
#include "driving/follow_state.hpp"
#include "driving/visual_path.hpp"
#include "features/appearance.hpp"
#include "tracking/tracking_frame.hpp"

namespace homeward::driving {

/// One picture further along a path of views: estimates where the robot is on the map (PoseHypotheses), homes to the
/// view of the path that comes next there (Goedemé 2007 §7), and says when the destination's own is reached. No picture
/// moves the robot along its path but through the estimate. A path of one view and no map is homed to by itself
/// (single_view.hpp).
FollowResult follow(FollowState& state, const VisualPath& path, const features::Appearance& seen,
                    const tracking::TrackingFrame& frame, const Pose2& odometry, const FollowConfig& config,
                    std::uint64_t seed);

/// One picture further by the tracked features of the view homed to alone.
FollowResult track(FollowState& state, const VisualPath& path, const tracking::TrackingFrame& frame,
                   const Pose2& odometry, const FollowConfig& config, std::uint64_t seed);

/// One sweep, of `odometry`: whether it shows something on ways that a tour drove, were the robot where it takes itself
/// to be. Only the way driven between two sweeps makes the second one say something new.
/// Ours: tour_ways.hpp.
void see_ways(FollowState& state, const VisualPath& path, std::span<const Eigen::Vector2d> points_m,
              const Pose2& odometry);

/// Whether the next picture is better recognised (`follow`) than tracked (`track`).
bool wants_features(const FollowState& state);

/// Whether nothing but bearings, by what little is recognised of it, says where the view homed to lies.
bool is_unsure(const FollowState& state);

/// Where to drive now, robot frame: the view homed to, or nothing when too little is known of it.
std::optional<Eigen::Vector2d> goal(const FollowState& state, const Pose2& odometry, const FollowConfig& config);

}  // namespace homeward::driving
