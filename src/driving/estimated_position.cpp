// SPDX-License-Identifier: Apache-2.0
#include "driving/estimated_position.hpp"

#include <algorithm>
#include <functional>
#include <limits>

namespace homeward::driving {
namespace {

using Vector2 = Eigen::Vector2d;

/// Of the view that is nearest to a point of the map; nothing where none is near.
std::optional<PlaceId> place_at(const VisualPath& path, const Vector2& here_m) {
  constexpr double kReach_m = 3.0;
  double least_m = kReach_m;
  std::optional<PlaceId> place;
  for (int view = 0; view < path.placed(); ++view) {
    const double distance_m = (position_m(path.pose(view)) - here_m).norm();
    if (distance_m >= least_m || path.place_of(view).empty()) continue;
    least_m = distance_m;
    place = path.place_of(view);
  }
  return place;
}

/// What is asked for to arrive. Where views lie by edges alone, they are too far off for more; and there is no other
/// place to be taken for this one.
double least_of_arrival(const VisualPath& path, const FollowConfig& config) {
  constexpr double kByEdges = 0.9;
  return path.index ? config.arrived_probability : std::min(kByEdges, config.arrived_probability);
}

}  // namespace

double position_probability(const FollowState& state, const VisualPath& path) {
  return path.alone() ? 1.0 : state.hypotheses.best_probability();
}

double drives_above(const FollowState& state, const FollowConfig& config) {
  return state.looked_around ? config.likelier : config.drive_above;
}

double arrival_probability(const FollowState& state, const VisualPath& path, const FollowConfig& config) {
  if (path.alone()) return 1.0;
  // Where the belief is sure of another place, both may be right.
  constexpr double kAgrees_m = 3.0;
  constexpr double kDisagreeing = 0.5;
  const auto off_m = off_belief_m(state, path, config);
  const double agreeing = off_m && *off_m > kAgrees_m ? kDisagreeing : 1.0;
  return agreeing *
         state.hypotheses.probability_within(position_m(path.pose(path.size() - 1)), config.arrived_within_m);
}

bool is_certain_of_arrival(const FollowState& state, const VisualPath& path, const FollowConfig& config,
                           bool somebody_says_so) {
  const bool unknown_to_the_map = state.belief_lost && !path.alone() && !somebody_says_so;
  return !unknown_to_the_map && arrival_probability(state, path, config) >= least_of_arrival(path, config);
}

bool stays_certain_of_arrival(const FollowState& state, const VisualPath& path, const FollowConfig& config) {
  constexpr double kWavers = 0.07;
  return arrival_probability(state, path, config) >= least_of_arrival(path, config) - kWavers;
}

double share_when_here(const FollowState& state, const VisualPath& path, const FollowConfig& config) {
  if (path.alone()) return kLeastShareAlone;
  // A few features of things far off agree with any place: that is for those who may be metres away. By night less than
  // the usual share of a view taken by day may be left at its own spot.
  constexpr double kOfLeast = 0.5;
  const double least = homing::VisualHoming::kLeastShare;
  return is_certain_of_arrival(state, path, config) ? kOfLeast * least : least;
}

std::optional<PlaceId> estimated_place(const FollowState& state, const VisualPath& path, const FollowConfig& config) {
  if (path.alone() || position_probability(state, path) < config.drive_above) return std::nullopt;
  return place_at(path, position_m(state.hypotheses.best()->map_from_robot));
}

std::vector<PossiblePlace> possible_places(const FollowState& state, const VisualPath& path) {
  constexpr double kOnePlace_m = 2.0;
  constexpr double kLeast = 0.01;
  constexpr std::size_t kMost = 4;
  if (path.alone()) return {};
  struct Spot {
    Vector2 at_m;
    double probability;
  };
  std::vector<Spot> spots;
  for (const PoseHypothesis& one : state.hypotheses.all()) {
    const Vector2 at_m = position_m(one.map_from_robot);
    const auto same =
        std::ranges::find_if(spots, [&](const Spot& spot) { return (spot.at_m - at_m).norm() < kOnePlace_m; });
    if (same != spots.end()) {
      same->probability += one.weight;
    } else {
      spots.push_back({at_m, one.weight});
    }
  }
  std::ranges::stable_sort(spots, std::greater<>(), &Spot::probability);
  std::vector<PossiblePlace> places;
  for (const Spot& spot : spots) {
    if (spot.probability < kLeast || places.size() == kMost) break;
    const auto place = place_at(path, spot.at_m);
    if (!place || std::ranges::find(places, *place, &PossiblePlace::place) != places.end()) continue;
    places.push_back({*place, spot.probability});
  }
  return places;
}

std::optional<double> off_path_m(const FollowState& state, const VisualPath& path, const FollowConfig& config) {
  if (path.alone() || position_probability(state, path) < drives_above(state, config)) return std::nullopt;
  const Vector2 here_m = position_m(state.hypotheses.best()->map_from_robot);
  // Where the path is the destination's view alone, the robot begins anywhere in its place.
  constexpr double kWithinPlace_m = 3.0;
  double least_m = (position_m(path.pose(0)) - here_m).norm();
  if (path.size() == 1) return std::max(0.0, least_m - kWithinPlace_m);
  for (int view = 0; view + 1 < path.size(); ++view) {
    const Vector2 from_m = position_m(path.pose(view));
    const Vector2 piece_m = position_m(path.pose(view + 1)) - from_m;
    const double length2 = std::max(1e-9, piece_m.squaredNorm());
    const double along = std::clamp((here_m - from_m).dot(piece_m) / length2, 0.0, 1.0);
    least_m = std::min(least_m, (from_m + along * piece_m - here_m).norm());
  }
  return least_m;
}

std::optional<double> off_belief_m(const FollowState& state, const VisualPath& path, const FollowConfig& config) {
  constexpr double kSure = 0.8;
  if (path.alone() || !state.belief || state.belief->probability < kSure) return std::nullopt;
  if (position_probability(state, path) < config.drive_above) return std::nullopt;
  if (!state.belief->view) return std::numeric_limits<double>::infinity();
  return (position_m(path.pose(*state.belief->view)) - position_m(state.hypotheses.best()->map_from_robot)).norm();
}

}  // namespace homeward::driving
