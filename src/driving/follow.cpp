// SPDX-License-Identifier: Apache-2.0
#include "driving/follow.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/angles.hpp"
#include "driving/estimated_position.hpp"
#include "driving/homed_view.hpp"
#include "driving/sightings.hpp"
#include "driving/single_view.hpp"

namespace homeward::driving {
namespace {

using Vector2 = Eigen::Vector2d;

/// The robot is where odometry says now.
void drive_on(FollowState& state, const Pose2& odometry, const FollowConfig& config) {
  if (!state.begun) {
    state.begun = true;
    state.odometry = odometry;
    state.hypotheses = PoseHypotheses(config.pose);
  }
  const Pose2 step = inverse(state.odometry) * odometry;
  const double driven_m = std::hypot(step.x_m, step.y_m);
  state.blind_m += driven_m;
  state.since_belief_m += driven_m;
  state.odometry = odometry;
  if (state.view.known()) state.view.drift(driven_m, config.track);
  state.hypotheses.predict(step);
}

/// A local map's answer as a measurement, where there is one.
std::optional<SightedPose> pose_of(const Result<homing::TargetSeen>& answer) {
  if (!answer || !answer->target_m) return std::nullopt;
  return SightedPose{{answer->target_m->x(), answer->target_m->y(), answer->vector.turn_rad}, answer->covariance_m2};
}

ViewSighting sighting_of(const FollowState& state, const VisualPath& path, const SightedPose& pose) {
  ViewSighting sighting;
  sighting.map_from_view = path.pose(state.index);
  sighting.spread_m = path.spread_m;
  sighting.pose = pose;
  return sighting;
}

/// Whether what the local map of the view homed to says can be: by the estimate, where that knows the place.
bool can_be(const FollowState& state, const VisualPath& path, const SightedPose& pose, const FollowConfig& config) {
  if (state.hypotheses.best_probability() < config.drive_above) return true;
  return state.hypotheses.agrees(sighting_of(state, path, pose));
}

/// Where the view homed to lies by the estimate, unless its own pictures say so better.
void place_view(FollowState& state, const VisualPath& path) {
  const PoseHypothesis* best = state.hypotheses.best();
  if (best == nullptr) return;
  const Pose2 odometry_from_map = state.odometry * inverse(best->map_from_robot);
  const Pose2 view = odometry_from_map * path.pose(state.index);
  const Eigen::Matrix2d turned = Eigen::Rotation2Dd(odometry_from_map.theta_rad).toRotationMatrix();
  const Eigen::Matrix2d covariance = turned * best->covariance.topLeftCorner<2, 2>() * turned.transpose() +
                                     path.spread_m * path.spread_m * Eigen::Matrix2d::Identity();
  constexpr double kApart = 3.0;  // standard deviations between what its pictures said and the estimate
  if (state.view.known()) {
    const Vector2 off_m = position_m(view) - state.view.position_m();
    const Eigen::Matrix2d sum = covariance + state.view.covariance_m2();
    const bool agrees = off_m.dot(sum.inverse() * off_m) < kApart * kApart;
    if (agrees && state.view.covariance_m2().trace() <= covariance.trace()) return;
  }
  state.view.settle(position_m(view), covariance, view.theta_rad);
}

/// A piece of the path, by the view that it ends at, and how far from it the robot is.
struct NearestPiece {
  int end = 0;
  double away_m = 1e9;
};

/// Of the pieces that end at the views `from` to `to`. At the path's first view begins no piece.
NearestPiece nearest_piece(const FollowState& state, const VisualPath& path, const Vector2& here_m, int from, int to) {
  const auto at_m = [&](int view) { return position_m(path.pose(view)); };
  // Another piece must be nearer by so much, and an earlier one by more, unless the robot is behind where the present
  // one begins: where a path doubles back, both pieces lie beside it.
  constexpr double kKeeps_m = 0.3;
  constexpr double kBack_m = 1.0;
  const bool behind =
      state.index > 0 && (here_m - at_m(state.index - 1)).dot(at_m(state.index) - at_m(state.index - 1)) < 0.0;
  NearestPiece nearest;
  for (int end = std::max(0, from); end <= std::min(path.size() - 1, to); ++end) {
    const Vector2 to_m = at_m(end);
    const Vector2 from_m = end > 0 ? at_m(end - 1) : to_m;
    const Vector2 piece_m = to_m - from_m;
    const double along = piece_m.squaredNorm() > 1e-9 ? (here_m - from_m).dot(piece_m) / piece_m.squaredNorm() : 1.0;
    double away_m = (from_m + std::clamp(along, 0.0, 1.0) * piece_m - here_m).norm();
    if (end != state.index) away_m += end < state.index && !behind ? kBack_m : kKeeps_m;
    if (away_m < nearest.away_m) nearest = {end, away_m};
  }
  return nearest;
}

/// The view of the path that comes next where the robot is. It goes on from the view homed to; a robot that has just
/// found out that it is on quite another piece of the path goes on from there, if a map says where the pieces lie.
int next_view(const FollowState& state, const VisualPath& path, const Vector2& here_m, const FollowConfig& config) {
  constexpr double kBeside_m = 2.0;
  const NearestPiece near =
      nearest_piece(state, path, here_m, state.index - config.look_along, state.index + config.look_along);
  const bool leaps = path.index != nullptr && state.hypotheses.best_probability() >= config.leap_above;
  if (near.away_m < kBeside_m || !leaps) return near.end;
  const NearestPiece any = nearest_piece(state, path, here_m, 0, path.size() - 1);
  return any.away_m < kBeside_m ? any.end : near.end;
}

/// Whether a view on the way is done with: reached, or the robot is level with it on the way to the next.
bool is_passed(const VisualPath& path, int view, const Vector2& here_m, const FollowConfig& config) {
  const Vector2 to_view = position_m(path.pose(view)) - here_m;
  if (to_view.norm() < config.pass_m) return true;
  if (to_view.norm() > config.abreast_m) return false;
  return to_view.dot(position_m(path.pose(view + 1)) - position_m(path.pose(view))) < 0.0;
}

/// Goes on to the view that comes next by the estimate, which may be one before when the robot was driven back.
void choose_view(FollowState& state, const VisualPath& path, const FollowConfig& config, FollowResult& result) {
  const PoseHypothesis* best = state.hypotheses.best();
  if (best == nullptr || state.hypotheses.best_probability() < drives_above(state, config)) return;
  const int last = path.size() - 1;
  const int before = state.index;
  const Vector2 here_m = position_m(best->map_from_robot);
  state.index = next_view(state, path, here_m, config);
  while (state.index < last && is_passed(path, state.index, here_m, config)) ++state.index;
  state.furthest = std::max(state.furthest, state.index);
  if (state.index == before) return;
  state.view = ViewTrack();
  state.measured = false;
  state.behind = 0;
  result.vector.reset();
}

/// Takes in what the local map of the view homed to says; one that cannot be is begun anew.
bool take_local_map(FollowState& state, const VisualPath& path, const Result<homing::TargetSeen>& answer,
                    const FollowConfig& config, FollowResult& result) {
  const auto pose = pose_of(answer);
  if (pose && !can_be(state, path, *pose, config)) {
    state.measured = false;
    constexpr int kPatience = 3;
    if (answer->began || ++state.contradictions >= kPatience) {
      state.visual = new_homing(config);
      state.contradictions = 0;
    }
    return false;
  }
  if (!pose) {
    state.measured = false;
    return false;
  }
  state.contradictions = 0;
  return take_in(state, answer, config, result);
}

/// The server's belief is one more piece of evidence: of the whole map, but by the same pictures, so that it counts
/// little, and only once for a stretch of the way.
void apply_belief(FollowState& state, const VisualPath& path) {
  constexpr double kSure = 0.8;
  constexpr double kOdds = 3.0;
  constexpr double kWithin_m = 2.0;
  constexpr double kApart_m = 1.0;
  if (!state.belief || state.belief->probability < kSure || state.hypotheses.empty()) return;
  if (state.since_belief_m < kApart_m) return;
  state.since_belief_m = 0.0;
  std::optional<Vector2> at_m;
  if (state.belief->view) at_m = position_m(path.pose(*state.belief->view));
  state.hypotheses.apply_odds(at_m, kWithin_m, kOdds, std::min(kMostByOthers, state.belief->probability));
}

void end_picture(FollowState& state, const VisualPath& path, const FollowConfig& config, FollowResult& result) {
  choose_view(state, path, config, result);
  place_view(state, path);
  if (state.index + 1 != path.size()) return;
  result.at_end = is_reached(state, path, config, result) && is_certain_of_arrival(state, path, config);
}

FollowResult follow_path(FollowState& state, const VisualPath& path, const features::Appearance& seen,
                         const tracking::TrackingFrame& frame, const FollowConfig& config, std::uint64_t seed) {
  FollowResult result;
  std::vector<ComparedView> compared = compare_views(state, path, seen, config, seed);
  const features::Appearance& view = path.appearance(state.index);
  homing::VisualHoming& visual = homing_of(state, config);
  const auto answer = visual.update(seen, view, state.odometry, distance_known(state, true), frame, seed);
  const double share = answer ? homing::shared_share(seen, view, answer->vector.inliers) : 0.0;
  const bool taken = take_local_map(state, path, answer, config, result);
  if (taken) {
    state.alike = share;
    state.most_alike = std::max(share, state.most_alike);
  }
  std::vector<ViewSighting> sightings;
  for (ComparedView& one : compared) {
    if (taken && one.view == state.index) {
      one.sighting.pose = pose_of(answer);
      if (!one.sighting.direction) {
        one.sighting.share = share;
        one.sighting.agreeing = answer->vector.inliers;
      }
    }
    sightings.push_back(one.sighting);
  }
  state.hypotheses.weigh(sightings);
  result.recognised =
      std::ranges::any_of(sightings, [](const ViewSighting& sighting) { return sighting.direction || sighting.pose; });
  apply_belief(state, path);
  const bool agrees = std::ranges::any_of(sightings, [&](const ViewSighting& sighting) {
    return sighting.direction && sighting.direction->confidence >= config.believe && state.hypotheses.agrees(sighting);
  });
  if (agrees) {
    result.answered = true;
    state.blind_m = 0.0;
  }
  end_picture(state, path, config, result);
  return result;
}

}  // namespace

bool is_unsure(const FollowState& state) { return !state.measured && !state.bearings.empty(); }

std::optional<Eigen::Vector2d> goal(const FollowState& state, const Pose2& odometry, const FollowConfig& config) {
  if (!state.view.known()) return std::nullopt;
  const Pose2 moved = inverse(state.odometry) * odometry;
  const double blind_m = state.blind_m + std::hypot(moved.x_m, moved.y_m);
  if (blind_m > config.blind_m) return std::nullopt;
  const Pose2 view = inverse(odometry) * Pose2{state.view.position_m().x(), state.view.position_m().y(), 0.0};
  return Eigen::Vector2d(view.x_m, view.y_m);
}

bool wants_features(const FollowState& state) {
  return state.visual_index != state.index || state.visual.wants_features();
}

void see_ways(FollowState& state, const VisualPath& path, std::span<const Vector2> points_m, const Pose2& odometry) {
  constexpr double kLeast_m = 0.25;
  constexpr double kIndependent_m = 2.0;  // what stands on a way is seen for some metres
  if (path.ways.empty() || state.hypotheses.empty()) return;
  double news = 1.0;
  if (state.ways_seen_from) {
    const Pose2 moved = inverse(*state.ways_seen_from) * odometry;
    const double driven_m = std::hypot(moved.x_m, moved.y_m);
    if (driven_m < kLeast_m) return;
    news = std::min(1.0, driven_m / kIndependent_m);
  }
  state.ways_seen_from = odometry;
  // The hypotheses are of where the latest picture was taken.
  const Pose2 moved = inverse(state.odometry) * odometry;
  const Eigen::Rotation2Dd turn(moved.theta_rad);
  std::vector<Vector2> then_m;
  then_m.reserve(points_m.size());
  for (const Vector2& point_m : points_m) then_m.push_back(turn * point_m + position_m(moved));
  weigh_by_ways(state.hypotheses, then_m, path.ways, news);
}

FollowResult track(FollowState& state, const VisualPath& path, const tracking::TrackingFrame& frame,
                   const Pose2& odometry, const FollowConfig& config, std::uint64_t seed) {
  FollowResult result;
  drive_on(state, odometry, config);
  const auto answer = homing_of(state, config).track(frame, odometry, seed);
  if (path.alone()) {
    take_in(state, answer, config, result);
    result.at_end = is_reached(state, path, config, result);
    return result;
  }
  if (take_local_map(state, path, answer, config, result)) {
    state.hypotheses.refine(sighting_of(state, path, *pose_of(answer)));
  }
  end_picture(state, path, config, result);
  return result;
}

FollowResult follow(FollowState& state, const VisualPath& path, const features::Appearance& seen,
                    const tracking::TrackingFrame& frame, const Pose2& odometry, const FollowConfig& config,
                    std::uint64_t seed) {
  drive_on(state, odometry, config);
  return path.alone() ? home_to_single_view(state, path, seen, frame, config, seed)
                      : follow_path(state, path, seen, frame, config, seed);
}

}  // namespace homeward::driving
