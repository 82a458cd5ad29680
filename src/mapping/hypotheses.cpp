// SPDX-License-Identifier: Apache-2.0
#include "mapping/hypotheses.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>

#include "mapping/dempster_shafer.hpp"

namespace homeward::mapping {
namespace {

map::Decision decide(const map::Masses& masses, const HypothesisConfig& config) {
  if (support(masses) > config.accept_support) return map::Decision::kAccepted;
  if (plausibility(masses) < config.reject_plausibility) return map::Decision::kRejected;
  return map::Decision::kUndecided;
}

/// Merged subclusters.
class Groups {
 public:
  explicit Groups(int items) : group_(static_cast<std::size_t>(items)), members_(group_.size()) {
    std::iota(group_.begin(), group_.end(), 0);
    for (std::size_t i = 0; i < members_.size(); ++i) members_[i] = {static_cast<int>(i)};
  }
  [[nodiscard]] int of(int item) const { return group_[static_cast<std::size_t>(item)]; }
  [[nodiscard]] const std::vector<int>& members(int group) const { return members_[static_cast<std::size_t>(group)]; }
  void merge(int a, int b) {
    auto& kept = members_[static_cast<std::size_t>(std::min(of(a), of(b)))];
    auto& gone = members_[static_cast<std::size_t>(std::max(of(a), of(b)))];
    const int group = std::min(of(a), of(b));
    for (const int item : gone) group_[static_cast<std::size_t>(item)] = group;
    kept.insert(kept.end(), gone.begin(), gone.end());
    gone.clear();
  }
  [[nodiscard]] std::vector<int> numbered() const {
    std::vector<int> number(group_.size(), -1);
    std::vector<int> result;
    int next = 0;
    for (const int group : group_) {
      int& n = number[static_cast<std::size_t>(group)];
      if (n < 0) n = next++;
      result.push_back(n);
    }
    return result;
  }

 private:
  std::vector<int> group_;                 // of each item
  std::vector<std::vector<int>> members_;  // of each group, by its first item
};

/// Finds the hypotheses near another one: in squares of the plane of both positions, as wide as evidence reaches.
class HypothesisGrid {
 public:
  explicit HypothesisGrid(double reach) : width_(std::max(reach, 1.0)) {}
  void add(std::size_t hypothesis, double position_a, double position_b) {
    squares_[{cell(position_a), cell(position_b)}].push_back(hypothesis);
  }
  /// All within reach and some more, ascending.
  [[nodiscard]] std::vector<std::size_t> around(double position_a, double position_b) const {
    std::vector<std::size_t> found;
    for (const std::int64_t a : {-1, 0, 1}) {
      for (const std::int64_t b : {-1, 0, 1}) {
        const auto square = squares_.find({cell(position_a) + a, cell(position_b) + b});
        if (square != squares_.end()) found.insert(found.end(), square->second.begin(), square->second.end());
      }
    }
    std::ranges::sort(found);
    return found;
  }

 private:
  [[nodiscard]] std::int64_t cell(double position) const {
    return static_cast<std::int64_t>(std::floor(position / width_));
  }

  double width_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<std::size_t>> squares_;
};

}  // namespace

map::Hypothesis kept_hypothesis(const LoopHypothesis& hypothesis, const ImageId& prototype_a,
                                const ImageId& prototype_b) {
  map::Hypothesis kept;
  kept.prototype_a = prototype_a;
  kept.prototype_b = prototype_b;
  kept.similarity = hypothesis.similarity;
  kept.masses_before = hypothesis.before;
  kept.masses_after = hypothesis.after;
  kept.support = support(hypothesis.after);
  kept.plausibility = plausibility(hypothesis.after);
  kept.decision = hypothesis.decision;
  kept.by = hypothesis.by;
  return kept;
}

std::vector<LoopHypothesis> formulate_hypotheses(std::span<const Subcluster> subclusters,
                                                 const SimilarityFunction& similarity, const HypothesisConfig& config) {
  std::map<int, std::vector<int>> by_cluster;
  for (std::size_t i = 0; i < subclusters.size(); ++i) {
    by_cluster[subclusters[i].cluster].push_back(static_cast<int>(i));
  }
  std::vector<LoopHypothesis> hypotheses;
  for (std::size_t a = 0; a < subclusters.size(); ++a) {
    const std::vector<int>& cluster = by_cluster.at(subclusters[a].cluster);
    for (auto b = std::ranges::upper_bound(cluster, static_cast<int>(a)); b != cluster.end(); ++b) {
      LoopHypothesis hypothesis;
      hypothesis.a = static_cast<int>(a);
      hypothesis.b = *b;
      hypothesis.similarity = std::clamp(similarity(hypothesis.a, hypothesis.b), 0.0, 1.0);
      hypothesis.before = hypothesis.after = evidence(hypothesis.similarity, config.own_weight);
      hypotheses.push_back(hypothesis);
    }
  }
  return hypotheses;
}

double weigh_way(std::span<LoopHypothesis> hypotheses, const WayFunction& way, const HypothesisConfig& config) {
  double agreed = 0.0;
  double decided = 0.0;
  for (LoopHypothesis& hypothesis : hypotheses) {
    hypothesis.way = way(hypothesis.a, hypothesis.b);
    if (hypothesis.way.verdict == TrackVerdict::kUnknown) continue;
    const bool agrees = hypothesis.way.verdict == TrackVerdict::kAgrees;
    const double weight = hypothesis.similarity * (agrees ? hypothesis.way.sharpness : 1.0);
    decided += weight;
    if (agrees) agreed += weight;
  }
  const double contradicted = decided - agreed;
  const double reliability =
      std::max(0.0, config.looks_trusted + agreed - contradicted) / (config.looks_trusted + decided);
  for (LoopHypothesis& hypothesis : hypotheses) {
    if (hypothesis.way.verdict != TrackVerdict::kContradicts) {
      // As much of the decision as the way leaves to looks, they have to be worth trusting for.
      const double sharpness = hypothesis.way.verdict == TrackVerdict::kAgrees ? hypothesis.way.sharpness : 0.0;
      hypothesis.reliability = sharpness + (1.0 - sharpness) * reliability;
      hypothesis.before = combine(evidence(hypothesis.similarity, config.own_weight * hypothesis.reliability),
                                  evidence(1.0, config.agreeing_way_mass * sharpness));
    } else {
      hypothesis.before = evidence(0.0, config.contradicting_way_mass);
    }
    hypothesis.after = hypothesis.before;
  }
  return reliability;
}

void collect_evidence(std::span<LoopHypothesis> hypotheses, std::span<const Subcluster> subclusters,
                      std::span<const double> position_of, const HypothesisConfig& config) {
  const auto position = [&](int subcluster) {
    return position_of[static_cast<std::size_t>(subclusters[static_cast<std::size_t>(subcluster)].prototype)];
  };
  HypothesisGrid counted(config.neighbour_threshold_images);
  for (std::size_t i = 0; i < hypotheses.size(); ++i) {
    // The way is one piece of evidence, which each hypothesis has had once, so neighbours only pass on what they look
    // like.
    if (hypotheses[i].way.verdict == TrackVerdict::kContradicts) continue;
    counted.add(i, position(hypotheses[i].a), position(hypotheses[i].b));
  }
  for (LoopHypothesis& hypothesis : hypotheses) {
    hypothesis.after = hypothesis.before;
    const bool excluded = hypothesis.way.verdict == TrackVerdict::kContradicts;
    const auto nearby =
        excluded ? std::vector<std::size_t>() : counted.around(position(hypothesis.a), position(hypothesis.b));
    for (const std::size_t other : nearby) {
      const LoopHypothesis& neighbour = hypotheses[other];
      if (&neighbour == &hypothesis) continue;
      const double distance = std::abs(position(hypothesis.a) - position(neighbour.a)) +
                              std::abs(position(hypothesis.b) - position(neighbour.b));
      const double weight = neighbour_weight(distance, config.neighbour_threshold_images);
      if (!(weight > 0.0)) continue;
      hypothesis.after = combine(hypothesis.after, evidence(neighbour.similarity, weight * neighbour.reliability));
    }
    if (hypothesis.by != map::Decider::kMethod) continue;
    hypothesis.decision = excluded ? map::Decision::kRejected : decide(hypothesis.after, config);
    // Where looks cannot be trusted, many of them that agree cannot either: what deceives one deceives its neighbours.
    const bool looks_alone = hypothesis.reliability < config.least_reliability;
    if ((looks_alone || !hypothesis.meets) && hypothesis.decision == map::Decision::kAccepted) {
      hypothesis.decision = map::Decision::kUndecided;
    }
  }
}

std::vector<int> merge_accepted(int subclusters, std::span<LoopHypothesis> hypotheses,
                                const std::function<bool(int, int)>& apart) {
  std::set<std::pair<int, int>> rejected;
  std::vector<LoopHypothesis*> accepted;
  for (LoopHypothesis& hypothesis : hypotheses) {
    if (hypothesis.decision == map::Decision::kRejected) rejected.insert(std::minmax(hypothesis.a, hypothesis.b));
    if (hypothesis.decision == map::Decision::kAccepted) accepted.push_back(&hypothesis);
  }
  // A person's word first, then by support; equal support keeps the order of the list.
  std::ranges::stable_sort(accepted, [](const LoopHypothesis* x, const LoopHypothesis* y) {
    const bool x_by_person = x->by != map::Decider::kMethod;
    const bool y_by_person = y->by != map::Decider::kMethod;
    if (x_by_person != y_by_person) return x_by_person;
    if (x->across != y->across) return y->across;
    return support(x->after) > support(y->after);
  });
  Groups groups(subclusters);
  for (LoopHypothesis* hypothesis : accepted) {
    if (groups.of(hypothesis->a) == groups.of(hypothesis->b)) continue;
    const std::vector<int>& left = groups.members(groups.of(hypothesis->a));
    const std::vector<int>& right = groups.members(groups.of(hypothesis->b));
    const bool conflict = std::ranges::any_of(left, [&](int x) {
      return std::ranges::any_of(right, [&](int y) { return rejected.contains(std::minmax(x, y)) || apart(x, y); });
    });
    if (conflict) {
      hypothesis->decision = map::Decision::kUndecided;
    } else {
      groups.merge(hypothesis->a, hypothesis->b);
    }
  }
  return groups.numbered();
}

}  // namespace homeward::mapping
