// SPDX-License-Identifier: Apache-2.0
#include "agent/driving/follow.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/angles.hpp"

namespace homeward::agent {
namespace {

// Of a view that pictures alone tell of. Rendered houses: 0.13 and more of its features are recognised from half a
// metre, by night too, and 0.03 (median) from five metres.
constexpr double kAloneShare = 0.1;

Eigen::Vector2d position(const Pose2& pose) { return {pose.x_m, pose.y_m}; }

bool is_sure(const homing::HomeVector& vector, const FollowConfig& config) {
  return vector.confidence >= config.sure && vector.inliers >= config.sure_inliers;
}

/// Bayes' rule: a probability whose odds are multiplied.
double with_odds(double probability, double odds) {
  return probability * odds / (probability * odds + 1.0 - probability);
}

/// Where the views after a known one must lie by the map's edges.
void expect_onwards(FollowState& state, const VisualPath& path, int from) {
  constexpr double kKnownTo_m = 3.0;  // beyond that much doubt an expectation is worth nothing
  for (int i = from; i + 1 < static_cast<int>(path.views.size()); ++i) {
    const auto index = static_cast<std::size_t>(i);
    const ViewTrack& track = state.tracks[index];
    const auto& edge = path.edges[index];
    if (!track.known() || track.doubt_m() > kKnownTo_m || !edge || !edge->bearing_rad || !edge->length_m) return;
    const double angle_rad = track.heading_rad() + *edge->bearing_rad;
    const Eigen::Vector2d along(std::cos(angle_rad), std::sin(angle_rad));
    const Eigen::Vector2d across(-along.y(), along.x());
    const double along_m = 0.35 * *edge->length_m + 0.15;
    const double across_m = (edge->weak ? 0.5 : 0.25) * *edge->length_m + 0.1;
    state.tracks[index + 1].expect(track.position_m() + *edge->length_m * along,
                                   track.covariance_m2() + along_m * along_m * along * along.transpose() +
                                       across_m * across_m * across * across.transpose(),
                                   wrap_angle(track.heading_rad() + edge->turn_rad.value_or(0.0)));
  }
}

/// How far the view homed to is, as the map's edges and other pictures say; `mapped`: not these pictures alone.
std::optional<homing::DistancePrior> distance_known(const ViewTrack& track, const Eigen::Vector2d& here, bool mapped) {
  if (!track.known()) return std::nullopt;
  const double distance_m = std::max(0.1, (track.position_m() - here).norm());
  return homing::DistancePrior{distance_m, std::clamp(track.doubt_m() / distance_m, 0.1, 0.8), mapped};
}

homing::VisualHoming new_homing(const FollowConfig& config) {
  homing::VisualHomingConfig visual = config.visual;
  visual.first = config.homing;
  visual.prior_odds = config.path_odds;
  visual.begin_confidence = config.believe;
  return homing::VisualHoming(visual);
}

/// The homing to the view homed to, begun anew when that is another one.
homing::VisualHoming& homing_of(FollowState& state, const FollowConfig& config) {
  if (state.visual_index != state.index) {
    state.visual = new_homing(config);
    state.visual_index = state.index;
    state.votes.clear();
    state.undecided = state.given_up = 0;
    state.most_alike = 0.0;
  }
  return state.visual;
}

/// Whether an answer is worth taking in. Right at the view its bearing says nothing any more, and where it is does.
bool is_believed(const Result<homing::TargetSeen>& answer, const FollowConfig& config) {
  constexpr double kHere_m = 0.1;
  if (!answer) return false;
  if (answer->vector.confidence >= config.believe) return true;
  return answer->target_m && answer->target_m->norm() < kHere_m && answer->map_confidence >= config.believe;
}

/// Takes in where the view homed to is seen; false where that says nothing or contradicts what is known.
bool take_in(FollowState& state, const Result<homing::TargetSeen>& answer, const Pose2& odometry,
             const FollowConfig& config, FollowResult& result) {
  state.measured = false;
  if (!is_believed(answer, config)) return false;
  ViewTrack& track = state.tracks[static_cast<std::size_t>(state.index)];
  if (answer->target_m) {
    state.measured = true;
    const Eigen::Rotation2Dd turned(odometry.theta_rad);
    track.settle(position(odometry) + turned * *answer->target_m,
                 turned.toRotationMatrix() * answer->covariance_m2 * turned.toRotationMatrix().transpose(),
                 odometry.theta_rad + answer->vector.turn_rad);
  } else if (!track.observe(odometry, answer->vector, config.track)) {
    return false;
  }
  result.vector = answer->vector;
  result.tracks = answer->tracks;
  result.answered = true;
  state.blind_m = 0.0;
  return true;
}

/// Where the votes say that the view homed to is. Of one view alone the likeliest is tried where they stay divided, and
/// another where it was followed as far as odometry alone, in vain.
std::optional<VotedView> voted_view(FollowState& state, bool alone, const FollowConfig& config) {
  constexpr int kPatience = 20;  // pictures
  constexpr int kMostGivenUp = 3;
  if (state.votes.empty()) return std::nullopt;
  const bool undecided = alone && state.undecided >= kPatience;
  auto voted = state.votes.best(undecided);
  if (voted && alone && state.blind_m >= config.blind_m && state.given_up < kMostGivenUp) {
    BearingVotes left = state.votes.without(*voted);
    if (!left.empty()) {
      state.votes = std::move(left);
      state.blind_m = 0.0;
      ++state.given_up;
      voted = state.votes.best(true);
    }
  }
  state.undecided = voted && !undecided ? 0 : state.undecided + 1;
  return voted;
}

/// One more bearing, or a hint at one, to the view homed to, which nothing else says anything of; false while they say
/// nothing together or this one is none of those that do.
bool take_vote(FollowState& state, const VisualPath& path, const features::Appearance& seen,
               const std::optional<homing::HomeVector>& answer, const FollowConfig& config, std::uint64_t seed,
               FollowResult& result) {
  state.measured = false;
  const features::Appearance& view = path.views[static_cast<std::size_t>(state.index)];
  // Of a path somebody knows where else it can be looked for; of one view only its picture says anything.
  const bool alone = path.views.size() == 1;
  std::optional<homing::HomeVector> vector = answer;
  if (!vector && alone) {
    if (const auto hint = homing::uncertain_home_vector(seen, view, seed)) vector = *hint;
  }
  if (!vector && !alone) return false;
  if (vector) {
    const double share = homing::shared_share(seen, view, vector->inliers);
    const double guess_m = std::max(1.0, homing::usual_distance_m(share));
    state.votes.add(state.odometry, *vector, answer.has_value(), guess_m);
  }
  const auto voted = voted_view(state, alone, config);
  if (!voted) return false;
  state.tracks[static_cast<std::size_t>(state.index)].settle(voted->position_m, voted->covariance_m2,
                                                             voted->heading_rad);
  const bool agrees = vector && BearingVotes::agrees(*voted, state.odometry, *vector);
  if (agrees) result.vector = *vector;
  if (agrees && answer) state.blind_m = 0.0;
  // Hints, and what was voted before, are followed as far as odometry alone, and no farther.
  result.answered = state.blind_m < config.blind_m;
  return agrees;
}

/// What is left of a local map that cannot be right: where two views alone say that the view homed to lies is one more
/// vote.
bool vote_instead(FollowState& state, const VisualPath& path, const features::Appearance& seen,
                  const FollowConfig& config, std::uint64_t seed, FollowResult& result) {
  state.visual = new_homing(config);
  const auto alone = homing::home_vector(seen, path.views[static_cast<std::size_t>(state.index)], config.homing, seed);
  return take_vote(state, path, seen, alone ? std::optional(*alone) : std::nullopt, config, seed, result);
}

/// Whether an answer says that the view is right here although hardly anything of it is recognised: things far off show
/// no parallax, and a few of them agree with any place between here and there. `most_alike`: of it so far.
bool is_hollow(const homing::TargetSeen& answer, double most_alike, const VisualPath& path) {
  constexpr double kHere_m = 0.6;
  return answer.target_m && answer.target_m->norm() < kHere_m && most_alike < share_when_here(path);
}

/// Whether a local map of few features has turned round: it says that the view lies elsewhere than the bearings say
/// that led here.
bool is_turned_round(const FollowState& state, const homing::TargetSeen& answer, double most_alike,
                     const Pose2& odometry) {
  constexpr double kFar_m = 1.0;  // nearer, bearings voted before say little
  if (!answer.target_m || most_alike >= kAloneShare || state.votes.empty()) return false;
  const auto voted = state.votes.best();
  if (!voted) return false;
  const Eigen::Vector2d way_m = voted->position_m - position(odometry);
  const Eigen::Vector2d other_m = Eigen::Rotation2Dd(odometry.theta_rad) * *answer.target_m;
  return way_m.norm() > kFar_m && way_m.dot(other_m) < 0.5 * way_m.norm() * other_m.norm();
}

/// Whether a handful of features says of a view something else than is known of it already: the robot has driven away
/// from it for a while, round somebody, and another thing looks alike.
bool is_unlikely(const homing::TargetSeen& answer, double share, const ViewTrack& track, const Pose2& odometry,
                 const FollowConfig& config) {
  constexpr double kKnown = 0.5;  // doubt over distance
  if (!answer.began || share >= homing::VisualHoming::kLeastShare || !track.known()) return false;
  const double apart_m = (track.position_m() - position(odometry)).norm();
  return track.doubt_m() < kKnown * apart_m && !track.agrees(odometry, answer.vector, config.track);
}

/// The robot is where odometry says now.
void drive_on(FollowState& state, const VisualPath& path, const Pose2& odometry, const FollowConfig& config) {
  if (state.tracks.size() != path.views.size()) {
    state.tracks.assign(path.views.size(), ViewTrack());
    state.odometry = odometry;
  }
  const Pose2 step = inverse(state.odometry) * odometry;
  const double driven_m = std::hypot(step.x_m, step.y_m);
  state.blind_m += driven_m;
  state.odometry = odometry;
  for (ViewTrack& track : state.tracks) track.drift(driven_m, config.track);
}

/// Whether a view on the way is done with: reached, or the robot is level with it on the way to the next.
bool is_passed(const FollowState& state, int index, const Eigen::Vector2d& here, const FollowConfig& config) {
  const ViewTrack& track = state.tracks[static_cast<std::size_t>(index)];
  if (!track.known()) return false;
  const Eigen::Vector2d to_view = track.position_m() - here;
  if (to_view.norm() < config.pass_m && track.doubt_m() < config.pass_m) return true;
  const ViewTrack& next = state.tracks[static_cast<std::size_t>(index) + 1];
  if (!next.known() || to_view.norm() > config.abreast_m) return false;
  return to_view.dot(next.position_m() - track.position_m()) < 0.0;
}

/// To a view before the one homed to, when the robot has gone back behind it and it is seen clearly; the nearest first.
void fall_back(FollowState& state, const VisualPath& path, const features::Appearance& seen, const Pose2& odometry,
               const FollowConfig& config, std::uint64_t seed, FollowResult& result) {
  const Eigen::Vector2d here = position(odometry);
  const ViewTrack& homed = state.tracks[static_cast<std::size_t>(state.index)];
  if (!homed.known() || (homed.position_m() - here).norm() < config.abreast_m) return;
  for (int index = state.index - 1; index >= std::max(0, state.index - config.look_back); --index) {
    ViewTrack& track = state.tracks[static_cast<std::size_t>(index)];
    const ViewTrack& next = state.tracks[static_cast<std::size_t>(index) + 1];
    if (!track.known() || !next.known()) continue;
    const bool ahead = (track.position_m() - here).dot(next.position_m() - track.position_m()) > 0.0;
    if (!ahead) continue;
    auto vector = homing::home_vector(seen, path.views[static_cast<std::size_t>(index)], config.homing, seed);
    if (!vector) continue;
    vector->confidence = with_odds(vector->confidence, config.path_odds);
    if (!is_sure(*vector, config) || !track.agrees(odometry, *vector, config.track)) continue;
    track.observe(odometry, *vector, config.track);
    state.index = index;
    state.measured = false;
    state.blind_m = 0.0;
    result.answered = true;
    expect_onwards(state, path, index);
    return;
  }
}

/// Views that are done with are left, and whether the destination's own is reached.
void pass_views(FollowState& state, const VisualPath& path, const Pose2& odometry, const FollowConfig& config,
                FollowResult& result) {
  const int last = static_cast<int>(path.views.size()) - 1;
  const int first = state.index;
  const Eigen::Vector2d here = position(odometry);
  while (state.index < last && is_passed(state, state.index, here, config)) ++state.index;
  state.furthest = std::max(state.furthest, state.index);
  expect_onwards(state, path, state.index);
  if (state.index != first) {
    result.vector.reset();
    state.measured = false;
  }
  if (state.index != last || !result.vector || !state.tracks.back().known()) return;
  const double distance_m = (state.tracks.back().position_m() - here).norm();
  // Bearings are sharp to within centimetres of a view: when it passes from ahead to behind, the robot is there.
  const bool behind = is_sure(*result.vector, config) && std::cos(result.vector->bearing_rad) < 0.0;
  state.behind = behind ? state.behind + 1 : 0;
  const bool coincides =
      result.vector->median_parallax_rad < config.homing.arrived_parallax_rad && state.alike > config.alike_share;
  if (state.most_alike < share_when_here(path)) return;
  result.at_end =
      state.measured ? distance_m < config.reached_m : coincides || (state.behind >= 2 && distance_m < config.nearby_m);
}

}  // namespace

double share_when_here(const VisualPath& path) {
  return path.views.size() == 1 ? kAloneShare : homing::VisualHoming::kLeastShare;
}

bool is_unsure(const FollowState& state) { return !state.measured && !state.votes.empty(); }

std::optional<Eigen::Vector2d> goal(const FollowState& state, const Pose2& odometry, const FollowConfig& config) {
  if (state.tracks.empty()) return std::nullopt;
  const Pose2 moved = inverse(state.odometry) * odometry;
  const double blind_m = state.blind_m + std::hypot(moved.x_m, moved.y_m);
  const ViewTrack& track = state.tracks[static_cast<std::size_t>(state.index)];
  if (!track.known() || blind_m > config.blind_m) return std::nullopt;
  const Pose2 view = inverse(odometry) * Pose2{track.position_m().x(), track.position_m().y(), 0.0};
  return Eigen::Vector2d(view.x_m, view.y_m);
}

bool wants_features(const FollowState& state) {
  return state.visual_index != state.index || state.visual.wants_features();
}

FollowResult track(FollowState& state, const VisualPath& path, const tracking::TrackingFrame& frame,
                   const Pose2& odometry, const FollowConfig& config, std::uint64_t seed) {
  FollowResult result;
  drive_on(state, path, odometry, config);
  const auto answer = homing_of(state, config).track(frame, odometry, seed);
  const int last = static_cast<int>(path.views.size()) - 1;
  if (take_in(state, answer, odometry, config, result) && state.index == last) {
    state.heading_left_rad = result.vector->turn_rad;
  }
  pass_views(state, path, odometry, config, result);
  return result;
}

FollowResult follow(FollowState& state, const VisualPath& path, const features::Appearance& seen,
                    const tracking::TrackingFrame& frame, const Pose2& odometry, const FollowConfig& config,
                    std::uint64_t seed) {
  FollowResult result;
  const int last = static_cast<int>(path.views.size()) - 1;
  drive_on(state, path, odometry, config);
  const int first = state.index;
  int clearest = -1;
  homing::VisualHoming& visual = homing_of(state, config);
  const ViewTrack& homed = state.tracks[static_cast<std::size_t>(first)];
  const bool bearings_alone = visual.map().empty() && (!homed.known() || !state.votes.empty());
  const auto prior = distance_known(homed, position(odometry), !bearings_alone);
  const auto answer = visual.update(seen, path.views[static_cast<std::size_t>(first)], odometry, prior, frame, seed);
  const double share =
      answer ? homing::shared_share(seen, path.views[static_cast<std::size_t>(first)], answer->vector.inliers) : 0.0;
  const double most_alike = std::max(share, state.most_alike);
  const bool hollow = answer && is_hollow(*answer, most_alike, path);
  bool taken = false;
  if (hollow) state.tracks[static_cast<std::size_t>(first)] = ViewTrack();
  if (hollow && path.views.size() > 1) {
    state.visual_index = -1;
    state.measured = false;
  } else if (hollow || (answer && is_turned_round(state, *answer, most_alike, odometry))) {
    taken = vote_instead(state, path, seen, config, seed, result);
  } else if (answer && !bearings_alone && is_unlikely(*answer, share, homed, odometry, config)) {
    state.visual = new_homing(config);
    state.measured = false;
  } else if (bearings_alone && !(answer && answer->target_m)) {
    taken = take_vote(state, path, seen, answer ? std::optional(answer->vector) : std::nullopt, config, seed, result);
  } else {
    taken = take_in(state, answer, odometry, config, result);
  }
  if (taken) {
    state.alike = share;
    state.most_alike = most_alike;
    if (is_sure(*result.vector, config)) clearest = first;
    expect_onwards(state, path, first);
    if (first == last) state.heading_left_rad = result.vector->turn_rad;
  }
  for (int index = first + 1; index <= std::min(last, first + config.look_ahead); ++index) {
    auto vector = homing::home_vector(seen, path.views[static_cast<std::size_t>(index)], config.homing, seed);
    if (!vector) continue;
    vector->confidence = with_odds(vector->confidence, config.path_odds);
    if (vector->confidence < config.believe) continue;
    ViewTrack& track = state.tracks[static_cast<std::size_t>(index)];
    // Views further on are seen from afar, and wrong answers agree with each other there: only clear ones move them.
    // Others may still say that the way is recognised.
    if (!is_sure(*vector, config)) {
      if (!track.known() || !track.agrees(odometry, *vector, config.track)) continue;
      result.answered = true;
      state.blind_m = 0.0;
      continue;
    }
    if (!track.observe(odometry, *vector, config.track)) continue;
    result.answered = true;
    state.blind_m = 0.0;
    if (clearest < 0) clearest = index;
    expect_onwards(state, path, index);
    if (index == last) state.heading_left_rad = vector->turn_rad;
  }
  // The view homed to is not to be seen and a later one is: it has been cut off.
  if (!state.tracks[static_cast<std::size_t>(first)].known() && clearest > first) {
    state.index = clearest;
    result.vector.reset();
    state.measured = false;
  }
  if (!result.answered) fall_back(state, path, seen, odometry, config, seed, result);
  pass_views(state, path, odometry, config, result);
  return result;
}

}  // namespace homeward::agent
