// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/pose2.hpp"
#include "features/appearance.hpp"
#include "homing/home_vector.hpp"

namespace homeward::agent {

/// The views to pass one after the other; the last one is the destination's own.
struct VisualPath {
  std::vector<features::Appearance> views;
};

struct FollowConfig {
  homing::HomingConfig homing;
  double pass_parallax_rad = 0.10;   // a view on the way is passed when the scene looks this little different
  double skip_parallax_rad = 0.35;   // or, from here on, as soon as a later one is clearly seen
  double sure = 0.8;                 // confidence of a clear answer
  int sure_inliers = 24;
  double believe = 0.5;              // below that an answer is not driven by
  int look_ahead = 3;                // views tried beyond the present one
  double remember_m = 1.2;           // so far the robot drives on by odometry when no view answers
  double metres_per_parallax = 4.0;  // rough depth of rooms: how far a view is for its parallax
};

/// Which view the robot homes to, and what it remembers of where that lies.
struct FollowState {
  int index = 0;                      // of the view homed to
  std::optional<Pose2> goal_in_odom;  // where the view was last seen to lie; heading = heading there
  Pose2 seen_from;                    // odometry when it was
  double last_parallax_rad = 1.0;
  double least_parallax_rad = 1e9;  // of the final view, since it is homed to
  double turn_at_end_rad = 0.0;     // from the heading at seen_from to that of the destination's view
  int unanswered = 0;               // pictures in a row without an answer
};

struct FollowResult {
  std::optional<Eigen::Vector2d> goal_m;       // where to drive, robot frame
  std::optional<homing::HomeVector> vector;    // the answer it rests on, when there is a fresh one
  bool at_end = false;                         // the destination's view is reached
  bool blind = false;                          // no view answers and memory is used up
  double parallax_rad = 1.0;                   // of the view homed to
};

/// One picture further along a path of views: homes to the present view, passes it when it is near or a later one is
/// clearly seen, bridges gaps by odometry (Goedemé 2007 §7, with the home vector of each picture alone).
FollowResult follow(FollowState& state, const VisualPath& path, const features::Appearance& seen, const Pose2& odometry,
                    const FollowConfig& config, std::uint64_t seed);

/// Where the remembered goal lies between two pictures, robot frame.
std::optional<Eigen::Vector2d> remembered_goal(const FollowState& state, const Pose2& odometry, const FollowConfig& config);

}  // namespace homeward::agent
