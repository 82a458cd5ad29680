// SPDX-License-Identifier: Apache-2.0
#include "pipeline/report/facts.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>

#include "core/index.hpp"
#include "core/markup.hpp"
#include "map/graph.hpp"
#include "map/lookup.hpp"
#include "pipeline/report/html.hpp"

namespace homeward::pipeline {
namespace {

using Pair = std::pair<int, int>;

Pair ordered(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

int tour_of(const BuiltMap& built, int image) {
  return at(image) < built.notes.tour_of.size() ? built.notes.tour_of[at(image)] : 0;
}

float distance(const BuiltMap& built, int a, int b) {
  const bool known = std::max(a, b) < built.notes.pairs.images();
  return known ? built.notes.pairs.distance(a, b) : std::numeric_limits<float>::infinity();
}

void find_places(const map::TopologicalMap& map, ReportFacts& facts) {
  const auto images = map::image_indices(map);
  facts.place_of.assign(map.images.size(), -1);
  for (std::size_t p = 0; p < map.places.size(); ++p) {
    const auto prototype = images.find(map.places[p].prototype);
    facts.prototype_of.push_back(prototype == images.end() ? -1 : prototype->second);
    for (const ImageId& member : map.places[p].members) {
      const auto found = images.find(member);
      if (found != images.end()) facts.place_of[at(found->second)] = static_cast<int>(p);
    }
  }
}

void find_visits(const BuiltMap& built, ReportFacts& facts) {
  facts.visits_of.assign(built.map.places.size(), 0);
  for (int i = 0; i < static_cast<int>(facts.place_of.size()); ++i) {
    const int place = facts.place_of[at(i)];
    if (place < 0) continue;
    const bool goes_on = !facts.visits.empty() && facts.visits.back().place == place &&
                         facts.visits.back().last == i - 1 && tour_of(built, i) == tour_of(built, i - 1);
    if (goes_on) {
      facts.visits.back().last = i;
    } else {
      facts.visits.push_back({place, i, i});
      ++facts.visits_of[at(place)];
    }
  }
}

/// Edges between two places, both directions as one: weak if either is.
std::map<Pair, map::Edge> ways(const map::TopologicalMap& map) {
  const auto places = map::place_indices(map);
  std::map<Pair, map::Edge> result;
  for (const map::Edge& edge : map.edges) {
    const auto ends = map::ends_of(edge, places);
    if (!ends) continue;
    const auto [known, is_new] = result.try_emplace(ordered(ends->from, ends->to), edge);
    if (is_new) continue;
    known->second.weak = known->second.weak || edge.weak;
    known->second.confidence = std::min(known->second.confidence, edge.confidence);
  }
  return result;
}

/// Where the tours drove weak edges; stretches that touch are one.
void find_weak(const BuiltMap& built, ReportFacts& facts) {
  std::map<Pair, map::Edge> weak = ways(built.map);
  facts.edges = static_cast<int>(weak.size());
  std::erase_if(weak, [](const auto& way) { return !way.second.weak; });
  facts.weak_edges = static_cast<int>(weak.size());
  std::map<Pair, bool> driven;
  for (std::size_t v = 1; v < facts.visits.size(); ++v) {
    const Visit& before = facts.visits[v - 1];
    const Visit& after = facts.visits[v];
    const auto found = weak.find(ordered(before.place, after.place));
    if (found == weak.end() || tour_of(built, before.last) != tour_of(built, after.first)) continue;
    const bool first_time = driven.emplace(found->first, true).second;
    const bool touches = !facts.weak.empty() && facts.weak.back().last >= before.first;
    if (!first_time && !touches) continue;
    if (!touches) facts.weak.push_back({before.first, after.last, 0, 0.0, 1.0});
    WeakStretch& stretch = facts.weak.back();
    stretch.last = after.last;
    if (!first_time) continue;
    ++stretch.edges;
    stretch.length_m += found->second.length_m;
    stretch.least_confidence = std::min(stretch.least_confidence, found->second.confidence);
  }
  facts.weak_off_tour = facts.weak_edges - static_cast<int>(driven.size());
}

void find_look_alikes(const BuiltMap& built, ReportFacts& facts) {
  const map::TopologicalMap& map = built.map;
  const auto images = map::image_indices(map);
  std::map<Pair, int> hypothesis_of;
  for (std::size_t h = 0; h < map.hypotheses.size(); ++h) {
    const auto a = images.find(map.hypotheses[h].prototype_a);
    const auto b = images.find(map.hypotheses[h].prototype_b);
    if (a == images.end() || b == images.end()) continue;
    const auto [known, is_new] = hypothesis_of.try_emplace(
        ordered(facts.place_of[at(a->second)], facts.place_of[at(b->second)]), static_cast<int>(h));
    const auto similarity = [&](int index) { return map.hypotheses[at(index)].similarity; };
    if (!is_new && similarity(static_cast<int>(h)) > similarity(known->second)) known->second = static_cast<int>(h);
  }
  const map::PlaceGraph graph(map);
  constexpr int kNeighbours = 2;  // places so many edges apart look alike because they are near each other
  for (int a = 0; a < static_cast<int>(map.places.size()); ++a) {
    std::optional<std::vector<map::Reached>> reached;  // from a, once it is needed
    for (int b = a + 1; b < static_cast<int>(map.places.size()); ++b) {
      if (facts.prototype_of[at(a)] < 0 || facts.prototype_of[at(b)] < 0) continue;
      const float apart = distance(built, facts.prototype_of[at(a)], facts.prototype_of[at(b)]);
      if (!(apart <= built.notes.mapping.place_distance)) continue;
      if (!reached) reached = map::reach(graph, a, graph.size());
      LookAlike pair{a, b, static_cast<double>(apart), std::nullopt, -1};
      const auto found = std::ranges::find(*reached, b, &map::Reached::place);
      if (found != reached->end()) pair.hops = found->hops;
      if (pair.hops && *pair.hops <= kNeighbours) continue;
      const auto hypothesis = hypothesis_of.find({a, b});
      if (hypothesis != hypothesis_of.end()) pair.hypothesis = hypothesis->second;
      facts.look_alikes.push_back(pair);
    }
  }
  std::ranges::stable_sort(facts.look_alikes, {}, &LookAlike::distance);
}

void find_joined(const map::TopologicalMap& map, ReportFacts& facts) {
  const auto images = map::image_indices(map);
  for (const map::Hypothesis& hypothesis : map.hypotheses) {
    const auto a = images.find(hypothesis.prototype_a);
    const auto b = images.find(hypothesis.prototype_b);
    const bool known = a != images.end() && b != images.end() && facts.place_of[at(a->second)] >= 0;
    const bool joined = known && facts.place_of[at(a->second)] == facts.place_of[at(b->second)];
    facts.joined.push_back(joined ? 1 : 0);
    if (!joined && hypothesis.decision == map::Decision::kUndecided) ++facts.open;
  }
}

void find_gaps(const BuiltMap& built, ReportFacts& facts) {
  const std::vector<map::MapImage>& images = built.map.images;
  for (int i = 1; i < static_cast<int>(images.size()); ++i) {
    if (tour_of(built, i) != tour_of(built, i - 1)) continue;
    Gap gap{i - 1, 0.0, static_cast<double>(distance(built, i - 1, i))};
    gap.length = gap.distance;
    if (facts.metric) {
      const Pose2& a = *images[at(i - 1)].odometry;
      const Pose2& b = *images[at(i)].odometry;
      gap.length = std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
    }
    facts.gaps.push_back(gap);
  }
  std::ranges::stable_sort(facts.gaps, std::greater<>(), &Gap::length);
}

}  // namespace

double certainty(const map::Hypothesis& hypothesis) {
  return std::max(hypothesis.support, 1.0 - hypothesis.plausibility);
}

ReportFacts gather_facts(const BuiltMap& built) {
  const map::TopologicalMap& map = built.map;
  ReportFacts facts;
  facts.metric = !map.images.empty() &&
                 std::ranges::all_of(map.images, [](const map::MapImage& image) { return image.odometry.has_value(); });
  find_places(map, facts);
  find_visits(built, facts);
  facts.component_of = map::components(map::PlaceGraph(map));
  facts.parts = facts.component_of.empty() ? 0 : *std::ranges::max_element(facts.component_of) + 1;
  find_weak(built, facts);
  find_look_alikes(built, facts);
  find_joined(map, facts);
  find_gaps(built, facts);
  facts.uncertain_first.resize(map.hypotheses.size());
  std::iota(facts.uncertain_first.begin(), facts.uncertain_first.end(), 0);
  std::ranges::stable_sort(facts.uncertain_first, {}, [&](int index) { return certainty(map.hypotheses[at(index)]); });
  return facts;
}

std::string place_name(const map::Place& place) {
  const std::string id = escape_html(place.id.str());
  return place.label.empty() ? id : escape_html(place.label) + " (" + id + ")";
}

std::string picture_name(const ImageId& image) {
  const std::string& id = image.str();
  return escape_html(id.substr(id.rfind('/') + 1));
}

}  // namespace homeward::pipeline
