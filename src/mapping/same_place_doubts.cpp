// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>

#include "core/angles.hpp"
#include "core/index.hpp"
#include "features/aggregate.hpp"
#include "mapping/compare_all.hpp"
#include "mapping/dempster_shafer.hpp"
#include "mapping/doubt_kinds.hpp"
#include "mapping/hypotheses.hpp"
#include "mapping/parallel.hpp"
#include "matching/retrieval_index.hpp"

namespace homeward::mapping {
namespace {

using map::Decision;
using map::Doubt;

/// Two places that may be one, and why that is asked.
struct Pair {
  PlaceIndices places;
  std::vector<std::size_t> hypotheses;  // that are about them, the one that stands for them first
  double alike = 0.0;                   // as a whole: cosine of the codes of their prototypes
  PairRelation seen = {};
};

/// The more is known for a hypothesis, the sooner it is looked at.
bool speaks_more(const map::Hypothesis& a, const map::Hypothesis& b) {
  if (a.by != b.by) return a.by == map::Decider::kPerson;
  if (a.plausibility != b.plausibility) return a.plausibility > b.plausibility;
  return a.support > b.support;
}

using Pairs = std::map<PlaceIndices, Pair>;

Pairs hypothetical_pairs(const DoubtScene& scene) {
  const std::vector<map::Hypothesis>& hypotheses = scene.map().hypotheses;
  Pairs pairs;
  for (std::size_t h = 0; h < hypotheses.size(); ++h) {
    const int a = scene.place_of(hypotheses[h].prototype_a);
    const int b = scene.place_of(hypotheses[h].prototype_b);
    if (a < 0 || b < 0 || a == b) continue;
    Pair& pair = pairs[std::minmax(a, b)];
    pair.places = std::minmax(a, b);
    pair.hypotheses.push_back(h);
    if (speaks_more(hypotheses[h], hypotheses[pair.hypotheses.front()])) {
      std::swap(pair.hypotheses.front(), pair.hypotheses.back());
    }
  }
  return pairs;
}

/// Of each place those most like it as a whole, by an inverted index of their prototypes: loops that nobody asked about
/// are among them. A way between two of them speaks for two places already.
void add_look_alikes(const DoubtScene& scene, const DoubtConfig& config, Pairs& pairs) {
  constexpr std::uint64_t kSeed = 1;
  const std::vector<map::Place>& places = scene.map().places;
  std::vector<const features::FeatureSet*> sets;
  for (const map::Place& place : places) {
    if (!place.appearances.empty()) sets.push_back(&place.appearances.front().sift);
  }
  auto words = features::train_vocabulary(sets, matching::kRetrievalWords, kSeed);
  if (!words) return;
  auto index = matching::RetrievalIndex::create(std::move(*words));
  if (!index) return;
  for (std::size_t p = 0; p < places.size(); ++p) {
    // One without features is like none.
    if (!places[p].appearances.empty()) {
      static_cast<void>(index->add(std::to_string(p), places[p].appearances.front().sift));
    }
  }
  for (int p = 0; p < static_cast<int>(places.size()); ++p) {
    if (scene.place(p).appearances.empty()) continue;
    const auto wanted = at(config.look_alikes) + 1 + scene.beside(p).size();
    int taken = 0;
    for (const auto& candidate : index->query(scene.place(p).appearances.front().sift, wanted)) {
      const int other = std::stoi(candidate.id);
      if (other == p || scene.way(p, other) != nullptr || taken == config.look_alikes) continue;
      ++taken;
      Pair& pair = pairs[std::minmax(p, other)];
      pair.places = std::minmax(p, other);
      pair.alike = std::max(pair.alike, candidate.score);
    }
  }
}

/// The pairs that are worth a close look: what is undecided first, then what looks most alike.
std::vector<Pair> worth_a_look(Pairs pairs, const DoubtScene& scene, const DoubtConfig& config) {
  std::vector<Pair> chosen;
  for (auto& [places, pair] : pairs) chosen.push_back(std::move(pair));
  const auto rank = [&](const Pair& pair) {
    if (pair.hypotheses.empty()) return pair.alike;
    const map::Hypothesis& hypothesis = scene.map().hypotheses[pair.hypotheses.front()];
    return hypothesis.plausibility + (hypothesis.decision == Decision::kUndecided ? 1.0 : 0.0);
  };
  std::ranges::stable_sort(chosen, std::greater<>(), rank);
  chosen.resize(std::min(chosen.size(), at(config.most_compared)));
  return chosen;
}

SamePlaceSigns signs_of(const DoubtScene& scene, const Pair& pair, double way_m) {
  SamePlaceSigns signs;
  signs.distance = static_cast<double>(pair.seen.distance) / scene.map().motion.distance_scale;
  signs.confidence = static_cast<double>(pair.seen.confidence);
  signs.apart_m = scene.apart_m(scene.place(pair.places.first).prototype, scene.place(pair.places.second).prototype);
  signs.way_m = way_m;
  if (pair.hypotheses.empty()) return signs;
  const map::Hypothesis& hypothesis = scene.map().hypotheses[pair.hypotheses.front()];
  signs.belief = hypothesis.support + hypothesis.plausibility - 1.0;
  return signs;
}

void say_what_to_do(const DoubtScene& scene, const Pair& pair, Doubt& doubt) {
  using enum map::EditKind;
  doubt.if_yes.push_back(edit_of(kDecide, doubt.image_a, doubt.image_b, "accept"));
  if (pair.hypotheses.empty()) doubt.if_no.push_back(edit_of(kDecide, doubt.image_a, doubt.image_b, "reject"));
  constexpr std::size_t kMost = 20;
  for (const std::size_t h : pair.hypotheses) {
    const map::Hypothesis& hypothesis = scene.map().hypotheses[h];
    if (doubt.if_no.size() == kMost) break;
    doubt.if_no.push_back(edit_of(kDecide, hypothesis.prototype_a, hypothesis.prototype_b, "reject"));
  }
}

Doubt doubt_of(const DoubtScene& scene, const DoubtConfig& config, const Pair& pair) {
  const auto [a, b] = pair.places;
  Doubt doubt;
  doubt.kind = map::DoubtKind::kSamePlace;
  doubt.image_a = scene.place(a).prototype;
  doubt.image_b = scene.place(b).prototype;
  if (!pair.hypotheses.empty()) {
    const std::size_t h = pair.hypotheses.front();
    const map::Hypothesis& hypothesis = scene.map().hypotheses[h];
    doubt.hypothesis = h;
    doubt.image_a = hypothesis.prototype_a;
    doubt.image_b = hypothesis.prototype_b;
    doubt.by = hypothesis.by;
    const bool kept_apart = hypothesis.decision == Decision::kRejected;
    doubt.state = kept_apart ? Decision::kRejected : Decision::kUndecided;
  }
  if (scene.parted_by_a_person(a, b)) doubt.by = map::Decider::kPerson;
  doubt.place_a = scene.place(scene.place_of(doubt.image_a)).id;
  doubt.place_b = scene.place(scene.place_of(doubt.image_b)).id;
  const double way_m = scene.way_m(std::array{a}, std::array{b}, -1, std::nullopt, 20.0 * config.usual_detour_m);
  doubt.probability = probability_of_one_place(signs_of(scene, pair, way_m));
  doubt.effect = effect_of(way_m, config);
  say_what_to_do(scene, pair, doubt);
  return doubt;
}

/// By how much the layout makes it likelier that two places are one, a logarithm: near each other for its accuracy,
/// which falls with the way between them, or anywhere on the floor. Seldom it is wrong altogether.
double odds_of_layout(const SamePlaceSigns& signs) {
  constexpr double kFloor_m2 = 100.0;
  constexpr double kWrong = 1e-3;
  const double sigma_m = 0.3 + 0.05 * signs.way_m;
  const double z = *signs.apart_m / sigma_m;
  // A layout that is vague does not speak against them.
  const double peak = std::max(1.0, kFloor_m2 / (2.0 * kPi * sigma_m * sigma_m));
  return std::log((1.0 - kWrong) * peak * std::exp(-z * z / 2.0) + kWrong);
}

}  // namespace

double probability_of_one_place(const SamePlaceSigns& signs) {
  constexpr double kLeastDistance = 0.2;
  constexpr double kNothingInCommon = 20.0;
  const double distance = std::clamp(signs.distance, kLeastDistance, kNothingInCommon);
  // Of pairs of rendered houses and wards, half a place's extent apart or not: docs/experiments/doubts.md.
  double odds = -7.2 - 3.7 * std::log(distance) + 4.8 * signs.confidence + 3.3 * signs.belief;
  if (signs.apart_m) odds = -6.0 - 4.0 * std::log(distance) + 2.0 * signs.confidence + odds_of_layout(signs);
  return 1.0 / (1.0 + std::exp(-odds));
}

Result<std::vector<Doubt>> same_place_doubts(const DoubtScene& scene, const DoubtConfig& config, int threads,
                                             const std::stop_token& stop) {
  Pairs pairs = hypothetical_pairs(scene);
  add_look_alikes(scene, config, pairs);
  std::vector<Pair> chosen = worth_a_look(std::move(pairs), scene, config);
  const auto look = [&](std::size_t i) {
    constexpr std::uint64_t kSeed = 1;
    const map::Place& a = scene.place(chosen[i].places.first);
    const map::Place& b = scene.place(chosen[i].places.second);
    if (a.appearances.empty() || b.appearances.empty()) return;
    chosen[i].seen = relate(a.appearances.front(), b.appearances.front(), {}, kSeed);
  };
  if (!parallel_for(chosen.size(), threads, look, {}, stop)) {
    return fail(ErrorCode::kCancelled, "Looking for doubts was cancelled.");
  }
  std::vector<Doubt> doubts;
  doubts.reserve(chosen.size());
  for (const Pair& pair : chosen) doubts.push_back(doubt_of(scene, config, pair));
  return doubts;
}

}  // namespace homeward::mapping
