// SPDX-License-Identifier: Apache-2.0
#include "planning/second_look.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "core/index.hpp"
#include "map/graph.hpp"
#include "map/lookup.hpp"

namespace homeward::planning {
namespace {

/// The other places and how far they are along edges, nearest first (Dijkstra 1959).
std::vector<std::pair<double, int>> by_distance(const map::TopologicalMap& map, const RouteRequest& request, int from) {
  const map::PlaceGraph graph(map);
  std::vector<double> distance_m(map.places.size(), std::numeric_limits<double>::infinity());
  std::vector<std::pair<double, int>> reached;
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> open;
  distance_m[at(from)] = 0.0;
  open.emplace(0.0, from);
  while (!open.empty()) {
    const auto [here_m, here] = open.top();
    open.pop();
    if (here_m > distance_m[at(here)]) continue;
    if (here != from) reached.emplace_back(here_m, here);
    for (const map::Arc& arc : graph.arcs_from(here)) {
      const map::Edge& edge = map.edges[at(arc.edge)];
      const double there_m = here_m + std::max(0.0, edge.length_m);
      const bool closed = std::ranges::find(request.closed, Way{edge.from, edge.to}) != request.closed.end();
      const bool avoided = std::ranges::find(request.avoid, edge.to) != request.avoid.end();
      if (edge.blocked || closed || avoided || there_m >= distance_m[at(arc.to)]) continue;
      distance_m[at(arc.to)] = there_m;
      open.emplace(there_m, arc.to);
    }
  }
  return reached;
}

void append(Route& route, const Route& next) {
  route.places.insert(route.places.end(), next.places.begin() + 1, next.places.end());
  route.cost_m += next.cost_m;
  route.length_m += next.length_m;
  route.time_s += next.time_s;
  route.weak.insert(route.weak.end(), next.weak.begin(), next.weak.end());
  route.shortcuts.insert(route.shortcuts.end(), next.shortcuts.begin(), next.shortcuts.end());
  const bool known =
      route.length_from != map::LengthSource::kUnknown && next.length_from != map::LengthSource::kUnknown;
  route.length_from = known ? std::max(route.length_from, next.length_from) : map::LengthSource::kUnknown;
}

}  // namespace

double second_look_m(int look) {
  constexpr double kFirst_m = 5.0;
  return std::ldexp(kFirst_m, look);
}

Result<Route> plan_second_look(const map::TopologicalMap& map, const RouteRequest& request, double away_m) {
  const map::Place* from = map::find_place(map, request.from);
  if (from == nullptr) {
    return fail(ErrorCode::kUnknownPlace, "The map has no place " + request.from.str() + ".", "from");
  }
  auto places = by_distance(map, request, static_cast<int>(from - map.places.data()));
  const auto nearer = std::ranges::stable_partition(places, [&](const auto& one) { return one.first >= away_m; });
  std::ranges::reverse(nearer);
  constexpr double kLeast_m = 2.0;  // nearer, it is turned round at before anything else is seen
  for (const auto& [distance_m, place] : places) {
    if (distance_m < kLeast_m) continue;
    RouteRequest there = request;
    there.to = map.places[at(place)].id;
    auto route = plan_route(map, there);
    if (!route) continue;
    RouteRequest back = there;
    std::swap(back.from, back.to);
    const auto home = plan_route(map, back);
    if (!home) continue;
    append(*route, *home);
    return route;
  }
  return fail(ErrorCode::kNoRoute, "No way leads two metres away from place " + request.from.str() + " and back.",
              request.from.str());
}

}  // namespace homeward::planning
