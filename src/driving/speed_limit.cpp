// SPDX-License-Identifier: Apache-2.0
#include "driving/speed_limit.hpp"

#include <Eigen/Core>
#include <algorithm>

namespace homeward::driving {
namespace {

/// Whether it is on a way that no tour drove: also on the last bit of one whose end counts as passed already.
bool on_shortcut(const FollowState& state, const VisualPath& path, const FollowConfig& config) {
  if (path.on_shortcut(state.index)) return true;
  const PoseHypothesis* best = state.hypotheses.best();
  if (!path.on_shortcut(state.index - 1) || best == nullptr) return false;
  // Its end still lies ahead.
  const Pose2 end = path.pose(state.index - 1);
  const Pose2 begin = path.pose(state.index - 2);
  const Eigen::Vector2d way_m(end.x_m - begin.x_m, end.y_m - begin.y_m);
  const Eigen::Vector2d left_m(end.x_m - best->map_from_robot.x_m, end.y_m - best->map_from_robot.y_m);
  return left_m.norm() < config.abreast_m && left_m.dot(way_m) > 0.0;
}

}  // namespace

double speed_limit_mps(const DrivingState& state, const DrivingConfig& config) {
  const double limit_mps = std::min(state.mission->speed_limit_mps, config.body.max_speed_mps);
  if (!state.mission->homes()) return limit_mps;
  const bool slowly = on_shortcut(state.follow, state.mission->path, config.follow);
  return slowly ? std::min(limit_mps, config.speed.shortcut_mps) : limit_mps;
}

}  // namespace homeward::driving
