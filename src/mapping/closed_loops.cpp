// SPDX-License-Identifier: Apache-2.0
#include "mapping/closed_loops.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace homeward::mapping {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// The run that each tie belongs to, numbered by first tie: ties not more than `reach` images apart, over both passes.
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
      if (ties[t].a - ties[u].a + std::abs(ties[t].b - ties[u].b) > reach) continue;
      const int one = first_of(static_cast<int>(t));
      const int other = first_of(static_cast<int>(u));
      run[at(std::max(one, other))] = std::min(one, other);
    }
  }
  for (std::size_t t = 0; t < ties.size(); ++t) run[t] = first_of(static_cast<int>(t));
  return run;
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
  std::vector<ClosedWay::Without> without = way.without_own_group();
  return {std::move(way), std::move(tie_of), std::move(hypothesis_of), std::move(ties), std::move(without)};
}

std::vector<std::size_t> take_back(std::span<const LoopHypothesis> hypotheses, std::span<const Subcluster> subclusters,
                                   const PairTable& pairs, const TourTrack& track, const HypothesisConfig& config) {
  constexpr int kMostRuns = 50;
  std::vector<LoopHypothesis> left(hypotheses.begin(), hypotheses.end());
  std::vector<std::size_t> gone;
  for (int round = 0; round < kMostRuns; ++round) {
    const WayWithLoops closed = close_way(left, subclusters, pairs, track, config);
    double worst = track.sure_sigmas();
    std::pair<std::size_t, std::size_t> worst_run{0, 0};
    for (std::size_t begin = 0; begin < closed.ties.size();) {
      std::size_t end = begin;
      std::vector<double> misses;
      bool by_person = false;
      for (; end < closed.ties.size() && closed.ties[end].group == closed.ties[begin].group; ++end) {
        by_person = by_person || left[closed.hypothesis_of[end]].by != "method";
        if (closed.without[end].prediction.known) misses.push_back(closed.without[end].miss_sigmas);
      }
      if (!misses.empty() && !by_person) {
        const auto middle = misses.begin() + static_cast<std::ptrdiff_t>(misses.size() / 2);
        std::nth_element(misses.begin(), middle, misses.end());
        if (*middle > worst) {
          worst = *middle;
          worst_run = {begin, end};
        }
      }
      begin = end;
    }
    if (worst_run.first == worst_run.second) break;
    for (std::size_t t = worst_run.first; t < worst_run.second; ++t) {
      left[closed.hypothesis_of[t]].decision = map::Decision::kRejected;
      gone.push_back(closed.hypothesis_of[t]);
    }
  }
  std::ranges::sort(gone);
  return gone;
}

}  // namespace homeward::mapping
