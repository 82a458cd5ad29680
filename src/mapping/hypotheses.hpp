// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "map/topological_map.hpp"
#include "mapping/subclusters.hpp"

namespace homeward::mapping {

struct HypothesisConfig {
  double neighbour_threshold_images = 24.0;  // d_th of Goedemé 2006 eq. 5: hypotheses further away say nothing
  double own_weight = 0.75;                  // of a hypothesis's own similarity; the rest is ignorance (2006 §3.5)
  double accept_support = 0.8;  // above the 0.75 that one hypothesis alone can reach: neighbours must agree
  double reject_plausibility = 0.4;
};

/// "Subclusters a and b are one place."
struct LoopHypothesis {
  int a = 0;  // index of a subcluster; its prototype comes earlier on the tour than b's
  int b = 0;
  double similarity = 0.0;  // s_V
  map::Masses before;
  map::Masses after;
  map::Decision decision = map::Decision::kUndecided;
  std::string by = "method";
};

/// s_V in [0,1] of two subclusters, by their indices.
using SimilarityFunction = std::function<double(int, int)>;

/// One hypothesis for each pair of subclusters of one cluster, in the order of their prototypes.
std::vector<LoopHypothesis> formulate_hypotheses(std::span<const Subcluster> subclusters,
                                                 const SimilarityFunction& similarity, const HypothesisConfig& config);

/// Combines each hypothesis with the initial masses of its neighbours, in the order of the list, and decides.
/// position_of: where each image lies along the tours, in images; far apart for images of different tours.
void collect_evidence(std::span<LoopHypothesis> hypotheses, std::span<const Subcluster> subclusters,
                      std::span<const double> position_of, const HypothesisConfig& config);

/// The place of each subcluster, numbered by first subcluster: the union of accepted pairs, best supported first. A
/// pair that would bring two subclusters together which a rejected hypothesis or `apart` keeps apart is not merged; its
/// hypothesis becomes undecided.
std::vector<int> merge_accepted(int subclusters, std::span<LoopHypothesis> hypotheses,
                                const std::function<bool(int, int)>& apart);

}  // namespace homeward::mapping
