// SPDX-License-Identifier: Apache-2.0
#include "driving/sightings.hpp"

#include <algorithm>
#include <cmath>

#include "homing/visual_homing.hpp"
#include "matching/visual_distance.hpp"

namespace homeward::driving {
namespace {

double apart_m(const Pose2& a, const Pose2& b) { return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m); }

double with_odds(double probability, double odds) {
  return probability * odds / (probability * odds + 1.0 - probability);
}

void add(std::vector<int>& views, int view) {
  if (std::ranges::find(views, view) == views.end()) views.push_back(view);
}

/// The views nearest to a pose, at most `count` of those within `reach_m`.
std::vector<int> nearest(const VisualPath& path, const Pose2& pose, std::size_t count, double reach_m) {
  std::vector<std::pair<double, int>> near;
  for (int view = 0; view < path.placed(); ++view) {
    const double distance_m = apart_m(path.pose(view), pose);
    if (distance_m < reach_m) near.emplace_back(distance_m, view);
  }
  std::ranges::sort(near);
  std::vector<int> views;
  for (std::size_t k = 0; k < std::min(count, near.size()); ++k) views.push_back(near[k].second);
  return views;
}

std::vector<int> worth_comparing(const FollowState& state, const VisualPath& path, const features::Appearance& seen,
                                 const FollowConfig& config) {
  constexpr std::size_t kOfBest = 3;
  constexpr double kWorth = 1e-8;  // weight of a hypothesis: what was begun must be looked at to become probable
  constexpr double kRival = 1e-3;
  constexpr double kReach_m = 3.0;
  const auto most = static_cast<std::size_t>(config.most_compared);
  std::vector<int> views = {state.index};
  const bool knows = !state.hypotheses.empty();
  const int ahead = knows ? 1 : config.look_along;
  for (int view = state.index + 1; view <= std::min(state.index + ahead, path.size() - 1); ++view) add(views, view);
  std::size_t count = kOfBest;
  for (const PoseHypothesis& hypothesis : state.hypotheses.all()) {
    if (hypothesis.weight < kWorth || views.size() >= most) break;
    for (const int view : nearest(path, hypothesis.map_from_robot, count, kReach_m)) add(views, view);
    count = hypothesis.weight > kRival ? 2 : 1;
  }
  if (!knows) {
    for (const int view : nearest(path, path.pose(0), kOfBest, kReach_m)) add(views, view);
  }
  if (state.belief && state.belief->view) add(views, *state.belief->view);
  // What looks most like it, wherever that is: somebody may have carried the robot off.
  constexpr std::size_t kAlike = 3;
  constexpr std::size_t kAlikeUnsure = 8;  // while it finds out which of them it is
  if (path.index) {
    const bool sure = state.hypotheses.best_probability() >= config.leap_above;
    for (const int view : path.index->find(seen, sure ? kAlike : kAlikeUnsure)) add(views, view);
  }
  return views;
}

/// That the robot is where its path begins is one thing, however many views around show it, and it is nearest to the
/// first of them.
void share_start(std::vector<ComparedView>& compared, const Pose2& begins) {
  constexpr double kBeside_m = 1.0;
  const auto shows = [](const ComparedView& one) { return one.at_start && one.sighting.direction; };
  const auto nearness = [&](const ComparedView& one) {
    return std::exp(-0.5 * std::pow(apart_m(one.sighting.map_from_view, begins) / kBeside_m, 2.0));
  };
  double sum = 0.0;
  for (const ComparedView& one : compared) sum += shows(one) ? nearness(one) : 0.0;
  for (ComparedView& one : compared) {
    if (shows(one)) one.sighting.prior_share *= nearness(one) / sum;
  }
}

}  // namespace

std::vector<ComparedView> compare_views(const FollowState& state, const VisualPath& path,
                                        const features::Appearance& seen, const FollowConfig& config,
                                        std::uint64_t seed) {
  constexpr double kBeside_m = 2.5;  // the wheels may have slipped so far,
  constexpr double kBesideShare = 1e-2;
  constexpr double kCarriedShare = 1e-5;  // or somebody has carried the robot anywhere and nothing was noticed of it
  // At first it is where the path begins, if those are right who say so; else at one of the views that look like it.
  constexpr double kElsewhereShare = 0.02;
  constexpr double kOfOthers = 0.5;
  const double start_probability = std::min(kMostByOthers, path.start_probability);
  const double elsewhere_share = std::max(kElsewhereShare, kOfOthers * (1.0 - start_probability));
  constexpr double kBelievedShare = 0.05;  // the server's belief, where it is sure
  const PoseHypothesis* best = state.hypotheses.best();
  std::vector<ComparedView> compared;
  for (const int view : worth_comparing(state, path, seen, config)) {
    const features::Appearance& target = path.appearance(view);
    const matching::PairComparison pair = matching::compare(seen, target, {}, seed);
    ComparedView one;
    one.view = view;
    one.sighting.map_from_view = path.pose(view);
    one.sighting.spread_m = path.spread_m;
    const bool beside = best != nullptr ? apart_m(best->map_from_robot, path.pose(view)) < kBeside_m
                                        : apart_m(path.pose(0), path.pose(view)) < kBeside_m;
    one.sighting.prior_share = best != nullptr
                                   ? (beside ? kBesideShare : kCarriedShare)
                                   : (beside ? std::max(kElsewhereShare, start_probability) : elsewhere_share);
    one.at_start = best == nullptr && beside;
    if (state.belief && state.belief->view == view) {
      one.sighting.prior_share = std::max(one.sighting.prior_share, kBelievedShare * state.belief->probability);
    }
    if (pair.pose) {
      one.sighting.share = homing::shared_share(seen, target, pair.verified);
      one.sighting.agreeing = pair.verified;
      one.sighting.direction = SightedDirection{pair.pose->motion.direction_rad, pair.pose->motion.turn_rad,
                                                with_odds(pair.pose->confidence, config.path_odds),
                                                homing::usual_distance_m(one.sighting.share)};
    }
    compared.push_back(std::move(one));
  }
  if (best == nullptr) share_start(compared, path.pose(0));
  return compared;
}

}  // namespace homeward::driving
