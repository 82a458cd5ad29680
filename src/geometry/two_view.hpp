// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "geometry/epipolar_px.hpp"
#include "geometry/five_point.hpp"
#include "geometry/seen_point.hpp"
#include "geometry/triangulation.hpp"

namespace homeward::geometry {

struct TwoViewConfig {
  int fewest_pairs = 8;
  int max_iterations = 300;                 // five-point samples
  double sure_enough = 0.999;               // FivePointConfig
  double search_error_px = 1.0;             // a pair farther off explains nothing while the motion is searched
  double least_spread_px = 0.1;             // of the errors of right pairs, however well most agree
  double inlier_spreads = 2.5;              // a pair farther off than so many spreads is wrong (Rousseeuw & Leroy 1987)
  double most_direction_spread_rad = 0.35;  // a direction known worse is none where a turn alone explains most pairs
  double wrong_reach_px = 10.0;             // errors of wrong pairs may be anything up to
  std::optional<DrivingPrior> driving;      // where the views are from something that drives
  double least_parallax_px = 1.5;  // by which the best turn alone misses a quarter of the pairs: less is no baseline
};
/// Empty when valid; lists all problems.
std::vector<std::string> problems(const TwoViewConfig& config);

/// Two views of one scene: all of the motion but its length, and the points that it is known by.
struct TwoViewEstimate {
  ViewMotion motion;
  bool has_baseline = false;  // without: the views are turned about one viewpoint, target_in_current means nothing, and
                              // no point is known to be nearer than the sky
  std::vector<int> inliers;   // of the pairs given, rising
  std::vector<MeetingRays> rays;      // of the inliers; in units of the baseline
  double error_px = 0.0;              // root of the mean square of the distance, in each picture, of inliers from where
                                      // their triangulated points are seen
  double spread_px = 0.0;             // standard deviation of right pairs' errors, of both pictures together
  double parallax_px = 0.0;           // by which the best turn alone misses a quarter of the inliers
  double direction_spread_rad = 0.0;  // standard deviation of the direction where it is known worst, rivals included
  double lead = 0.0;  // by how much the log likelihood exceeds that of the best motion in another direction
};

/// What is known of a motion beside the pairs of points.
struct MotionExpectation {
  std::vector<ViewMotion> motions;                          // to begin at
  std::function<double(const ViewMotion&)> log_likelihood;  // of one, by what else was seen; none: nothing was
};

/// The motion between two views of a central camera, and where the points are: five-point samples (Nistér 2004) beside
/// those that are expected, each refined in pixels (Sampson error) on the pairs that agree with it, the
/// likeliest taken (by a mixture of right and wrong pairs, the prior, and what else is known); points by triangulation.
/// Where a turn alone explains what the pairs show, it is what is given. Deterministic by `seed`. Errors: kInvalidInput
/// with the first of `problems`, kTooLittleSupport (fewer than `fewest_pairs` pairs or inliers).
Result<TwoViewEstimate> estimate_two_view(std::span<const PointPair> pairs, const TwoViewConfig& config,
                                          std::uint64_t seed, const MotionExpectation& expected = {});

}  // namespace homeward::geometry
