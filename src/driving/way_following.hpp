// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "core/pose2.hpp"
#include "driving/body.hpp"

namespace homeward::driving {

/// How a way whose poses are known is kept to, and when it is clear enough for that.
struct WayFollowingConfig {
  double converges_m = 0.5;       // beside the way by so much the robot heads back to it at 45 degrees,
  double steepest_rad = 0.6;      // or at this angle at most
  double turn_per_rad_m = 4.0;    // curvature for each radian that its heading is off
  double sharpest_per_m = 2.5;    // curvature that is driven
  double ahead_m = 0.12;          // so far ahead the way's bend is taken: what the wheels take to follow
  double bend_over_m = 0.2;       // over so much of the way its bend is measured
  double off_m = 0.5;             // farther beside it, or
  double off_rad = 0.9;           // turned away from it by more, the way has to be found first
  double looks_m = 0.7;           // so far it is looked ahead for room,
  double step_m = 0.05;           // from one pose to the next
  double room_m = 0.03;           // beside the body: where the way led before, little is enough;
  double enough_m = 0.1;          // with less it keeps to where there is more,
  double most_beside_m = 0.06;    // so far beside the way at most
  double comfort_radius_m = 0.8;  // sharper arcs are driven slower,
  double slowest_share = 0.3;     // by this share of the speed at least
};

/// The motion that keeps a body to a way that was driven before, where there is little room beside it, as in a narrow
/// door: `way` in the robot frame, from the nearest of it on, without turns on the spot. Nothing where the way is too
/// far off, or where the body, driving on by this law, would come too near to something: a way has to be searched for
/// then (`drive_towards`). It is no promise that the motion is safe: `made_safe` has the last word.
///
/// Path following by curvature, lateral offset and heading in the frame that moves along the path (Samson, "Control of
/// chained systems: application to path following and time-varying point-stabilization of mobile robots", IEEE
/// Transactions on Automatic Control 40, 1995), with a bounded angle of approach; driving it ahead for room is ours.
std::optional<Motion> follow_way(const Body& body, std::span<const Eigen::Vector2d> points_m,
                                 std::span<const Pose2> way, double speed_mps, const WayFollowingConfig& config = {});

}  // namespace homeward::driving
