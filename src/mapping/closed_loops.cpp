// SPDX-License-Identifier: Apache-2.0
#include "mapping/closed_loops.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/index.hpp"
#include "core/median.hpp"

namespace homeward::mapping {
namespace {

/// The run that each tie belongs to, numbered by first tie: ties not more than `reach` images apart, over both passes,
/// and about as far on one pass as on the other, whichever way it was driven.
std::vector<int> runs_of(std::span<const LoopTie> ties, double reach) {
  std::vector<int> run(ties.size());
  std::iota(run.begin(), run.end(), 0);
  const auto first_of = [&](int t) {
    while (run[at(t)] != t) t = run[at(t)] = run[at(run[at(t)])];
    return t;
  };
  // In the order of a, so that only those shortly before need a look.
  for (std::size_t t = 0; t < ties.size(); ++t) {
    for (std::size_t u = t; u-- > 0 && ties[t].a - ties[u].a <= reach;) {
      const int on_a = ties[t].a - ties[u].a;
      const int on_b = std::abs(ties[t].b - ties[u].b);
      if (on_a + on_b > reach || std::abs(on_a - on_b) > reach / 3.0) continue;
      const int one = first_of(static_cast<int>(t));
      const int other = first_of(static_cast<int>(u));
      run[at(std::max(one, other))] = std::min(one, other);
    }
  }
  for (std::size_t t = 0; t < ties.size(); ++t) run[t] = first_of(static_cast<int>(t));
  return run;
}

/// What is known of each tie had its later stretch of the tour never been recognised, there or anywhere: where one run
/// is false, those of the same stretch along other passes mostly are false with it.
std::vector<ClosedWay::Without> without_own_stretch(const ClosedWay& way, std::span<const LoopTie> ties) {
  std::vector<ClosedWay::Without> result;
  for (std::size_t begin = 0; begin < ties.size();) {
    std::size_t end = begin;
    int first = ties[begin].b;
    int last = ties[begin].b;
    for (; end < ties.size() && ties[end].group == ties[begin].group; ++end) {
      first = std::min(first, ties[end].b);
      last = std::max(last, ties[end].b);
    }
    const auto within = [&](int image) { return image >= first && image <= last; };
    std::vector<std::size_t> of_stretch;
    for (std::size_t t = 0; t < ties.size(); ++t) {
      if (within(ties[t].a) || within(ties[t].b)) of_stretch.push_back(t);
    }
    const std::vector<ClosedWay::Without> without = way.without(of_stretch);
    for (std::size_t i = 0; i < of_stretch.size(); ++i) {
      if (of_stretch[i] >= begin && of_stretch[i] < end) result.push_back(without[i]);
    }
    begin = end;
  }
  return result;
}

/// Ties of the stretch of the tour that least fits where it was recognised, as if it had never been: those that miss by
/// more than `sure_sigmas`. Empty where all fit.
std::vector<std::size_t> worst_stretch(const WayWithLoops& closed, std::span<const LoopHypothesis> hypotheses,
                                       double sure_sigmas) {
  std::vector<std::size_t> worst;
  double worst_miss = sure_sigmas;
  const auto within = [](int image, const std::pair<int, int>& stretch) {
    return image >= stretch.first && image <= stretch.second;
  };
  for (std::size_t begin = 0; begin < closed.ties.size();) {
    std::size_t end = begin;
    std::pair<int, int> on_a{closed.ties[begin].a, closed.ties[begin].a};
    std::pair<int, int> on_b{closed.ties[begin].b, closed.ties[begin].b};
    for (; end < closed.ties.size() && closed.ties[end].group == closed.ties[begin].group; ++end) {
      on_a = {std::min(on_a.first, closed.ties[end].a), std::max(on_a.second, closed.ties[end].a)};
      on_b = {std::min(on_b.first, closed.ties[end].b), std::max(on_b.second, closed.ties[end].b)};
    }
    for (const auto& stretch : {on_a, on_b}) {
      std::vector<std::size_t> of_stretch;
      for (std::size_t t = 0; t < closed.ties.size(); ++t) {
        if (hypotheses[closed.hypothesis_of[t]].by != map::Decider::kMethod) continue;
        if (within(closed.ties[t].a, stretch) || within(closed.ties[t].b, stretch)) of_stretch.push_back(t);
      }
      const std::vector<ClosedWay::Without> without = closed.way.without(of_stretch);
      std::vector<double> misses;  // of the run
      std::vector<std::size_t> missing;
      for (std::size_t i = 0; i < of_stretch.size(); ++i) {
        if (!without[i].prediction.known) continue;
        if (of_stretch[i] >= begin && of_stretch[i] < end) misses.push_back(without[i].miss_sigmas);
        if (without[i].miss_sigmas > sure_sigmas) missing.push_back(of_stretch[i]);
      }
      if (misses.empty()) continue;
      const double usual_miss = median(std::move(misses));
      if (usual_miss <= worst_miss) continue;
      worst_miss = usual_miss;
      worst = missing;
    }
    begin = end;
  }
  return worst;
}

}  // namespace

WayWithLoops close_way(std::span<const LoopHypothesis> hypotheses, std::span<const Subcluster> subclusters,
                       const PairTable& pairs, const TourTrack& track, const HypothesisConfig& config) {
  // Images of one place: a third of its extent is what the distance seen may be wrong by.
  const double sigma = track.place_extent() / 3.0;
  std::vector<std::pair<LoopTie, std::size_t>> found;
  for (std::size_t h = 0; h < hypotheses.size(); ++h) {
    if (hypotheses[h].decision != map::Decision::kAccepted) continue;
    LoopTie tie;
    tie.a = subclusters[at(hypotheses[h].a)].prototype;
    tie.b = subclusters[at(hypotheses[h].b)].prototype;
    const PairRelation seen = pairs.relation(tie.a, tie.b);
    if (!seen.verified() || !track.joined(tie.a, tie.b)) continue;
    const double apart = track.apart(static_cast<double>(seen.distance));
    tie.x = apart * std::cos(static_cast<double>(seen.direction_rad));
    tie.y = apart * std::sin(static_cast<double>(seen.direction_rad));
    tie.turn_rad = static_cast<double>(seen.turn_rad);
    tie.sigma = sigma;
    found.emplace_back(tie, h);
  }
  std::ranges::stable_sort(found, {}, [](const auto& tie) { return std::pair(tie.first.a, tie.first.b); });
  std::vector<LoopTie> ties;
  ties.reserve(found.size());
  for (const auto& [tie, hypothesis] : found) ties.push_back(tie);
  const std::vector<int> run = runs_of(ties, config.neighbour_threshold_images / 2.0);
  for (std::size_t t = 0; t < found.size(); ++t) found[t].first.group = run[t];
  std::ranges::stable_sort(found, {}, [](const auto& tie) { return tie.first.group; });
  std::vector<int> tie_of(hypotheses.size(), -1);
  std::vector<std::size_t> hypothesis_of;
  ties.clear();
  for (const auto& [tie, hypothesis] : found) {
    tie_of[hypothesis] = static_cast<int>(ties.size());
    hypothesis_of.push_back(hypothesis);
    ties.push_back(tie);
  }
  ClosedWay way(track, ties);
  std::vector<ClosedWay::Without> without = without_own_stretch(way, ties);
  return {std::move(way), std::move(tie_of), std::move(hypothesis_of), std::move(ties), std::move(without)};
}

std::vector<std::size_t> take_back(std::span<const LoopHypothesis> hypotheses, std::span<const Subcluster> subclusters,
                                   const PairTable& pairs, const TourTrack& track, const HypothesisConfig& config) {
  constexpr int kMostRounds = 50;
  std::vector<LoopHypothesis> left(hypotheses.begin(), hypotheses.end());
  std::vector<std::size_t> gone;
  for (int round = 0; round < kMostRounds; ++round) {
    const WayWithLoops closed = close_way(left, subclusters, pairs, track, config);
    const std::vector<std::size_t> worst = worst_stretch(closed, left, track.sure_sigmas());
    if (worst.empty()) break;
    for (const std::size_t tie : worst) {
      left[closed.hypothesis_of[tie]].decision = map::Decision::kRejected;
      gone.push_back(closed.hypothesis_of[tie]);
    }
  }
  std::ranges::sort(gone);
  return gone;
}

}  // namespace homeward::mapping
