// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/index.hpp"
#include "mapping/doubt_kinds.hpp"

namespace homeward::mapping {
namespace {

using map::Doubt;

/// A visit to a place and what is known of it.
struct Judged {
  PlaceVisit visit;
  double stray = 0.0;  // probability that it shows another place than the prototype
};

/// How surely the prototype sees the place at the other end of a way, in either direction.
double sight(const DoubtScene& scene, int place, int other) {
  const WayFacts* way = other >= 0 ? scene.way(place, other) : nullptr;
  return way == nullptr ? 0.0 : way->confidence;
}

MixedPlaceSigns signs_of(const DoubtScene& scene, int place, const PlaceVisit& visit) {
  MixedPlaceSigns signs;
  // At an end of a tour there is but one way.
  const int before = visit.before >= 0 ? visit.before : visit.after;
  const int after = visit.after >= 0 ? visit.after : visit.before;
  std::tie(signs.other_sight, signs.surer_sight) =
      std::minmax({sight(scene, place, before), sight(scene, place, after)});
  signs.apart_m = scene.apart_m(scene.place(place).prototype, scene.image(visit.middle()));
  return signs;
}

std::vector<Judged> judged_visits(const DoubtScene& scene, int place) {
  const int prototype = scene.number_of(scene.place(place).prototype);
  std::vector<Judged> judged;
  for (const PlaceVisit& visit : scene.visits(place)) {
    const bool own = visit.first <= prototype && prototype <= visit.last;
    judged.push_back({visit, own ? 0.0 : probability_of_two_places(signs_of(scene, place, visit))});
  }
  return judged;
}

/// Where the tour came from before these visits and where it went on to, but for the place itself.
std::vector<int> places_around(const std::vector<Judged>& visits, bool strays, int place, double least_stray) {
  std::vector<int> around;
  for (const Judged& one : visits) {
    if ((one.stray >= least_stray) != strays) continue;
    for (const int other : {one.visit.before, one.visit.after}) {
      if (other >= 0 && other != place && std::ranges::find(around, other) == around.end()) around.push_back(other);
    }
  }
  return around;
}

/// Accepted hypotheses between pictures of the one group and of the other.
std::vector<std::size_t> hypotheses_between(const DoubtScene& scene, int place, const std::vector<ImageId>& leaving) {
  const auto leaves = [&](const ImageId& image) { return std::ranges::find(leaving, image) != leaving.end(); };
  std::vector<std::size_t> between;
  for (const std::size_t h : scene.hypotheses_within(place)) {
    const map::Hypothesis& one = scene.map().hypotheses[h];
    const bool joins = leaves(one.prototype_a) != leaves(one.prototype_b);
    if (joins && one.decision == map::Decision::kAccepted) between.push_back(h);
  }
  return between;
}

void say_what_to_do(const DoubtScene& scene, int place, const std::vector<ImageId>& leaving, Doubt& doubt) {
  using enum map::EditKind;
  constexpr std::size_t kMost = 20;
  map::Edit split = edit_of(kSplit, scene.place(place).prototype, {});
  split.images = leaving;
  doubt.if_no.push_back(std::move(split));
  if (scene.joined_by_a_person(leaving)) doubt.by = map::Decider::kPerson;
  for (const std::size_t h : hypotheses_between(scene, place, leaving)) {
    const map::Hypothesis& one = scene.map().hypotheses[h];
    if (!doubt.hypothesis) doubt.hypothesis = h;
    if (one.by == map::Decider::kPerson) doubt.by = map::Decider::kPerson;
    if (doubt.if_yes.size() == kMost) break;
    doubt.if_yes.push_back(edit_of(kDecide, one.prototype_a, one.prototype_b, "accept"));
    doubt.if_no.push_back(edit_of(kDecide, one.prototype_a, one.prototype_b, "reject"));
  }
  if (!doubt.hypothesis) doubt.if_yes.push_back(edit_of(kDecide, doubt.image_a, doubt.image_b, "accept"));
}

}  // namespace

double probability_of_two_places(const MixedPlaceSigns& signs) {
  // Of visits to places of rendered houses and wards, sound and wrongly merged: docs/experiments/doubts.md.
  double odds = -2.5 + 8.0 * (0.7 - signs.surer_sight) + 3.0 * (0.6 - signs.other_sight);
  if (signs.apart_m) odds += std::clamp(2.0 * (*signs.apart_m - 2.5), -5.0, 5.0);
  return 1.0 / (1.0 + std::exp(-odds));
}

std::vector<Doubt> mixed_place_doubts(const DoubtScene& scene, const DoubtConfig& config) {
  std::vector<Doubt> doubts;
  for (int place = 0; place < static_cast<int>(scene.map().places.size()); ++place) {
    if (scene.visits(place).size() < 2) continue;
    const std::vector<Judged> visits = judged_visits(scene, place);
    const auto worst = std::ranges::max_element(visits, {}, &Judged::stray);
    if (worst->stray < config.least_probability) continue;
    // Those that are as bad as the worst, or nearly, leave together.
    const double least_stray = worst->stray / 2.0;
    std::vector<ImageId> leaving;
    for (const Judged& one : visits) {
      if (one.stray < least_stray) continue;
      for (int i = one.visit.first; i <= one.visit.last; ++i) leaving.push_back(scene.image(i));
    }
    Doubt doubt;
    doubt.kind = map::DoubtKind::kMixedPlace;
    doubt.image_a = scene.place(place).prototype;
    doubt.image_b = scene.image(worst->visit.middle());
    doubt.place_a = doubt.place_b = scene.place(place).id;
    doubt.state = map::Decision::kAccepted;
    doubt.probability = worst->stray;
    const auto own = places_around(visits, false, place, least_stray);
    const auto others = places_around(visits, true, place, least_stray);
    doubt.effect = effect_of(scene.way_m(own, others, place, std::nullopt, 20.0 * config.usual_detour_m), config);
    say_what_to_do(scene, place, leaving, doubt);
    doubts.push_back(std::move(doubt));
  }
  return doubts;
}

}  // namespace homeward::mapping
