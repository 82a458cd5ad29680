// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "core/index.hpp"
#include "mapping/doubt_kinds.hpp"

namespace homeward::mapping {
namespace {

bool said_by_a_person(const DoubtScene& scene, const PlaceIndices& ends, const WayFacts& way) {
  const auto by_person = [&](int e) { return scene.map().edges[at(e)].by == map::Decider::kPerson; };
  return std::ranges::any_of(way.edges, by_person) || scene.way_said_by_a_person(ends.first, ends.second);
}

}  // namespace

double probability_of_no_way(const WaySigns& signs) {
  double odds = signs.driven ? -5.0 : 2.0;
  odds += signs.confidence > 0.2 ? -1.0 : 0.5;
  if (signs.apart_m) odds += std::clamp(1.5 * (*signs.apart_m - 1.5 * signs.length_m - 1.5), -1.0, 4.0);
  return 1.0 / (1.0 + std::exp(-odds));
}

std::vector<map::Doubt> way_doubts(const DoubtScene& scene, const DoubtConfig& config,
                                   const std::vector<double>& mixed) {
  std::vector<map::Doubt> doubts;
  for (const auto& [ends, way] : scene.ways()) {
    const auto [a, b] = ends;
    const auto is_shortcut = [&](int e) { return scene.map().edges[at(e)].shortcut; };
    if (std::ranges::any_of(way.edges, is_shortcut)) continue;  // a person has accepted it
    map::Doubt doubt;
    doubt.kind = map::DoubtKind::kWay;
    doubt.image_a = scene.place(a).prototype;
    doubt.image_b = scene.place(b).prototype;
    const WaySigns signs{way.driven, way.confidence, way.inliers, way.length_m,
                         scene.apart_m(doubt.image_a, doubt.image_b)};
    doubt.probability = probability_of_no_way(signs);
    if (way.driven) doubt.probability *= (1.0 - mixed[at(a)]) * (1.0 - mixed[at(b)]);
    if (doubt.probability < config.least_probability) continue;
    doubt.place_a = scene.place(a).id;
    doubt.place_b = scene.place(b).id;
    doubt.state = map::Decision::kAccepted;
    if (said_by_a_person(scene, ends, way)) doubt.by = map::Decider::kPerson;
    const double around_m = scene.way_m(std::array{a}, std::array{b}, -1, ends, 20.0 * config.usual_detour_m);
    doubt.effect = effect_of(std::max(0.0, around_m - way.length_m), config);
    // To open what is open tells nothing but that somebody looked.
    const map::Edge& edge = scene.map().edges[at(way.edges.front())];
    doubt.if_yes.push_back(edit_of(map::EditKind::kBlockEdge, doubt.image_a, doubt.image_b, "false"));
    if (edge.from != doubt.place_a) std::swap(doubt.if_yes.back().image_a, doubt.if_yes.back().image_b);
    if (edge.blocked) doubt.if_yes.back().text = "true";
    doubt.if_no.push_back(edit_of(map::EditKind::kRemoveEdge, doubt.image_a, doubt.image_b));
    doubts.push_back(std::move(doubt));
  }
  return doubts;
}

}  // namespace homeward::mapping
