// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "core/ids.hpp"
#include "map/topological_map.hpp"
#include "mapping/subclusters.hpp"
#include "mapping/track.hpp"

namespace homeward::mapping {

struct HypothesisConfig {
  double neighbour_threshold_images = 24.0;  // d_th of Goedemé 2006 eq. 5: hypotheses further away say nothing
  double own_weight = 0.75;                  // of a hypothesis's own similarity; the rest is ignorance (2006 §3.5)
  double accept_support = 0.8;  // above the 0.75 that one hypothesis alone can reach: neighbours must agree
  double reject_plausibility = 0.4;
  double agreeing_way_mass = 0.95;       // at most, for a hypothesis that the way driven agrees with
  double looks_trusted = 1.0;            // as if looks had been right so often before the first was held to the way
  double least_reliability = 0.7;        // below, a hypothesis is not accepted
  double contradicting_way_mass = 0.99;  // against one that it excludes
};

/// "Subclusters a and b are one place."
struct LoopHypothesis {
  int a = 0;  // index of a subcluster; its prototype comes earlier on the tour than b's
  int b = 0;
  double similarity = 0.0;  // s_V
  map::Masses before;
  map::Masses after;
  map::Decision decision = map::Decision::kUndecided;
  map::Decider by = map::Decider::kMethod;
  bool across = false;  // the two lie in different clusters
  bool meets = true;    // some picture of one shares as many features with one of the other as pictures of one spot do
  // It was accepted until the other loops that were closed excluded it. `before` then tells what spoke for it,
  // `after` the contradiction.
  bool taken_back = false;
  WayEvidence way;
  double reliability = 1.0;  // how far looks can be trusted here: the visual masses are discounted by it
};

/// The hypothesis as a map keeps it, which knows images instead of subclusters: those that stand for a and for b.
map::Hypothesis kept_hypothesis(const LoopHypothesis& hypothesis, const ImageId& prototype_a,
                                const ImageId& prototype_b);

/// What the way driven says of two subclusters, by their indices.
using WayFunction = std::function<WayEvidence(int, int)>;

/// s_V in [0,1] of two subclusters, by their indices.
using SimilarityFunction = std::function<double(int, int)>;

/// One hypothesis for each pair of subclusters of one cluster, in the order of their prototypes.
std::vector<LoopHypothesis> formulate_hypotheses(std::span<const Subcluster> subclusters,
                                                 const SimilarityFunction& similarity, const HypothesisConfig& config);

/// Weighs in the way driven. A hypothesis that it excludes is rejected whatever it looks like, and says nothing to
/// others; one that it agrees with gains mass. Where it cannot tell, looks count as far as they were right where it
/// could: the visual masses of such hypotheses are discounted (Shafer 1976, ch. 11) by (agreements - contradictions) /
/// (agreements + contradictions), weighted by s_V and by how sharply the way agrees, at least 0; where it agrees
/// without telling much, the rest is discounted alike. The difference, not the share of agreements: those lie mostly a
/// short way apart, where agreeing is easy. In a building of look-alike rooms looks alone then decide nothing, and
/// pairs without other evidence stay apart. Returns that factor; 1 where the way decides nothing.
double weigh_way(std::span<LoopHypothesis> hypotheses, const WayFunction& way, const HypothesisConfig& config);

/// Combines each hypothesis with the initial masses of its neighbours, in the order of the list, and decides.
/// position_of: where each image lies along the tours, in images; far apart for images of different tours.
void collect_evidence(std::span<LoopHypothesis> hypotheses, std::span<const Subcluster> subclusters,
                      std::span<const double> position_of, const HypothesisConfig& config);

/// The place of each subcluster, numbered by first subcluster: the union of accepted pairs, those within a cluster
/// before those across, best supported first. A pair that would bring two subclusters together which a rejected
/// hypothesis or `apart` keeps apart is not merged; its hypothesis becomes undecided.
std::vector<int> merge_accepted(int subclusters, std::span<LoopHypothesis> hypotheses,
                                const std::function<bool(int, int)>& apart);

}  // namespace homeward::mapping
