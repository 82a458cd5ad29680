// SPDX-License-Identifier: Apache-2.0
#include "driving/single_view.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/angles.hpp"
#include "driving/estimated_position.hpp"
#include "driving/homed_view.hpp"

namespace homeward::driving {
namespace {

/// Where the bearings say that the view homed to is. The likeliest is tried where they stay divided, and
/// another where it was followed as far as odometry alone, in vain.
std::optional<TriangulatedView> triangulated_view(FollowState& state, const FollowConfig& config) {
  constexpr int kPatience = 20;  // pictures
  constexpr int kMostGivenUp = 3;
  if (state.bearings.empty()) return std::nullopt;
  const bool undecided = state.undecided >= kPatience;
  auto triangulated = state.bearings.best(undecided);
  if (triangulated && state.blind_m >= config.blind_m && state.given_up < kMostGivenUp) {
    BearingEvidence left = state.bearings.without(*triangulated);
    if (!left.empty()) {
      state.bearings = std::move(left);
      state.blind_m = 0.0;
      ++state.given_up;
      triangulated = state.bearings.best(true);
    }
  }
  state.undecided = triangulated && !undecided ? 0 : state.undecided + 1;
  return triangulated;
}

/// One more bearing, or a hint at one, to the view homed to, which nothing else says anything of; false while they say
/// nothing together or this one is none of those that do.
bool take_bearing(FollowState& state, const VisualPath& path, const features::Appearance& seen,
                  const std::optional<homing::HomeVector>& answer, const FollowConfig& config, std::uint64_t seed,
                  FollowResult& result) {
  state.measured = false;
  const features::Appearance& view = path.views.front();
  std::optional<homing::HomeVector> vector = answer;
  if (!vector) {
    if (const auto hint = homing::uncertain_home_vector(seen, view, seed)) vector = *hint;
  }
  if (vector) {
    const double share = homing::shared_share(seen, view, vector->inliers);
    const double guess_m = std::max(1.0, homing::usual_distance_m(share));
    state.bearings.add(state.odometry, *vector, answer.has_value(), guess_m);
  }
  const auto triangulated = triangulated_view(state, config);
  if (!triangulated) return false;
  state.view.settle(triangulated->position_m, triangulated->covariance_m2, triangulated->heading_rad);
  const bool agrees = vector && BearingEvidence::agrees(*triangulated, state.odometry, *vector);
  if (agrees) result.vector = *vector;
  if (agrees && answer) state.blind_m = 0.0;
  // Hints, and where bearings met before, are followed as far as odometry alone, and no farther.
  result.answered = state.blind_m < config.blind_m;
  return agrees;
}

/// What is left of a local map that cannot be right: where two views alone say that the view homed to lies is one more
/// bearing.
bool take_bearing_instead(FollowState& state, const VisualPath& path, const features::Appearance& seen,
                          const FollowConfig& config, std::uint64_t seed, FollowResult& result) {
  state.visual = new_homing(config);
  const auto alone = homing::home_vector(seen, path.views.front(), config.homing, seed);
  return take_bearing(state, path, seen, alone ? std::optional(*alone) : std::nullopt, config, seed, result);
}

/// Whether an answer says that the view is right here although hardly anything of it is recognised: things far off show
/// no parallax, and a few of them agree with any place between here and there. `most_alike`: of it so far.
bool is_unsupported(const homing::TargetSeen& answer, double most_alike) {
  constexpr double kHere_m = 0.6;
  return answer.target_m && answer.target_m->norm() < kHere_m && most_alike < kLeastShareAlone;
}

/// Whether a local map of few features has turned round: it says that the view lies elsewhere than the bearings say
/// that led here.
bool is_turned_round(const FollowState& state, const homing::TargetSeen& answer, double most_alike) {
  constexpr double kFar_m = 1.0;  // nearer, earlier bearings say little
  if (!answer.target_m || most_alike >= kLeastShareAlone || state.bearings.empty()) return false;
  const auto triangulated = state.bearings.best();
  if (!triangulated) return false;
  const Eigen::Vector2d way_m = triangulated->position_m - position_m(state.odometry);
  const Eigen::Vector2d other_m = Eigen::Rotation2Dd(state.odometry.theta_rad) * *answer.target_m;
  return way_m.norm() > kFar_m && way_m.dot(other_m) < 0.5 * way_m.norm() * other_m.norm();
}

/// Whether a handful of features says of a view something else than is known of it already: the robot has driven away
/// from it for a while, round somebody, and another thing looks alike.
bool is_unlikely(const homing::TargetSeen& answer, double share, const FollowState& state, const FollowConfig& config) {
  constexpr double kKnown = 0.5;  // doubt over distance
  if (!answer.began || share >= homing::VisualHoming::kLeastShare || !state.view.known()) return false;
  const double apart_m = (state.view.position_m() - position_m(state.odometry)).norm();
  return state.view.doubt_m() < kKnown * apart_m && !state.view.agrees(state.odometry, answer.vector, config.track);
}

}  // namespace

FollowResult home_to_single_view(FollowState& state, const VisualPath& path, const features::Appearance& seen,
                                 const tracking::TrackingFrame& frame, const FollowConfig& config, std::uint64_t seed) {
  FollowResult result;
  const features::Appearance& view = path.views.front();
  homing::VisualHoming& visual = homing_of(state, config);
  const bool bearings_alone = visual.map().empty() && (!state.view.known() || !state.bearings.empty());
  const auto prior = distance_known(state, !bearings_alone);
  const auto answer = visual.update(seen, view, state.odometry, prior, frame, seed);
  const double share = answer ? homing::shared_share(seen, view, answer->vector.inliers) : 0.0;
  const double most_alike = std::max(share, state.most_alike);
  const bool unsupported = answer && is_unsupported(*answer, most_alike);
  bool taken = false;
  if (unsupported) state.view = ViewTrack();
  if (unsupported || (answer && is_turned_round(state, *answer, most_alike))) {
    taken = take_bearing_instead(state, path, seen, config, seed, result);
  } else if (answer && !bearings_alone && is_unlikely(*answer, share, state, config)) {
    state.visual = new_homing(config);
    state.measured = false;
  } else if (bearings_alone && !(answer && answer->target_m)) {
    taken =
        take_bearing(state, path, seen, answer ? std::optional(answer->vector) : std::nullopt, config, seed, result);
  } else {
    taken = take_in(state, answer, config, result);
  }
  if (taken) {
    state.alike = share;
    state.most_alike = most_alike;
  }
  result.at_end = is_reached(state, path, config, result);
  return result;
}

}  // namespace homeward::driving
