// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "driving/pose_hypotheses.hpp"

namespace homeward::driving {

/// A straight piece of way that a tour drove, map frame: nothing that stays stands on it.
struct TourWay {
  Eigen::Vector2d from_m;
  Eigen::Vector2d to_m;
};

/// How near what a range sensor sees comes to the middle of a way, were a hypothesis right: the fourth nearest point of
/// the way that is nearest, farther by what the pose is doubted, a metre at most; nothing where no way or no point is
/// near the robot. `points_m`: of one sweep, robot frame. What is hidden is not seen, and what is wide enough for a
/// robot is no wall.
std::optional<double> room_on_ways_m(std::span<const Eigen::Vector2d> points_m, std::span<const TourWay> ways,
                                     const PoseHypothesis& hypothesis);

/// What a sweep says of each hypothesis: one that puts a surface on a way that a tour drove is wrong, or something has
/// been put there; one that lets the ways go through what is seen to be free is right, or of a place that looks alike
/// in that, too. `news` of it, of 0 to 1, is not in the sweeps before. The method and its numbers are ours
/// (docs/experiments/telling_twins_apart.md).
void weigh_by_ways(PoseHypotheses& hypotheses, std::span<const Eigen::Vector2d> points_m, std::span<const TourWay> ways,
                   double news);

}  // namespace homeward::driving
