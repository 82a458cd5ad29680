// SPDX-License-Identifier: Apache-2.0
#include "planning/no_route.hpp"

#include <algorithm>
#include <deque>
#include <limits>
#include <optional>

#include "core/index.hpp"
#include "map/graph.hpp"
#include "map/lookup.hpp"

namespace homeward::planning {
namespace {

using map::NoRoute;
using map::Obstacle;
using map::ObstacleKind;

/// A way between neighbours that could be driven if what stands against it did not.
struct Wish {
  int to = 0;
  std::optional<ObstacleKind> obstacle;  // nothing: it can be driven
};

/// For each place the ways that leave it, each neighbour once, as free as it can be.
std::vector<std::vector<Wish>> wishes(const map::TopologicalMap& map, const RouteRequest& request) {
  std::vector<std::vector<Wish>> leaving(map.places.size());
  const auto index = map::place_indices(map);
  const auto add = [&](int from, const Wish& wish) {
    auto& known = leaving[at(from)];
    const auto same = std::ranges::find(known, wish.to, &Wish::to);
    if (same == known.end()) {
      known.push_back(wish);
    } else if (!wish.obstacle || same->obstacle == ObstacleKind::kOneWay) {
      *same = wish;
    }
  };
  for (const map::Edge& edge : map.edges) {
    const auto ends = map::ends_of(edge, index);
    if (!ends) continue;
    Wish wish{ends->to, std::nullopt};
    if (std::ranges::find(request.closed, Way{edge.from, edge.to}) != request.closed.end()) {
      wish.obstacle = ObstacleKind::kClosed;
    }
    if (edge.blocked) wish.obstacle = ObstacleKind::kBlocked;
    add(ends->from, wish);
    const bool known_back =
        std::ranges::find(leaving[at(ends->to)], ends->from, &Wish::to) != leaving[at(ends->to)].end();
    if (!known_back) add(ends->to, {ends->from, ObstacleKind::kOneWay});
  }
  return leaving;
}

std::string listed(const std::vector<std::string>& items) {
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) text += i + 1 == items.size() ? " and " : ", ";
    text += items[i];
  }
  return text;
}

}  // namespace

std::string named(const map::Place& place) {
  return place.label.empty() ? place.id.str() : place.id.str() + " (" + place.label + ")";
}

NoRoute explain_no_route(const map::TopologicalMap& map, const RouteRequest& request) {
  const auto index = map::place_indices(map);
  const int from = index.at(request.from);
  const int to = index.at(request.to);
  NoRoute why;
  why.from = request.from;
  why.to = request.to;
  const std::vector<int> parts = map::components(map::PlaceGraph(map));
  why.connected = parts[at(from)] == parts[at(to)];
  if (!why.connected) {
    why.places_near_from = static_cast<std::size_t>(std::ranges::count(parts, parts[at(from)]));
    return why;
  }
  std::vector<char> avoided(map.places.size(), 0);
  for (const PlaceId& id : request.avoid) {
    if (const auto found = index.find(id); found != index.end()) avoided[at(found->second)] = 1;
  }
  // The way with the fewest obstacles: breadth first over costs 0 and 1 (2 where the place is to be avoided as well).
  const std::vector<std::vector<Wish>> leaving = wishes(map, request);
  struct Reached {
    int obstacles = std::numeric_limits<int>::max();
    int before = -1;
    std::optional<ObstacleKind> over;
  };
  std::vector<Reached> reached(map.places.size());
  reached[at(from)].obstacles = 0;
  std::vector<std::deque<int>> waiting(1, std::deque<int>{from});  // by number of obstacles
  for (std::size_t level = 0; level < waiting.size(); ++level) {
    while (!waiting[level].empty()) {
      const int here = waiting[level].front();
      waiting[level].pop_front();
      if (reached[at(here)].obstacles < static_cast<int>(level)) continue;
      for (const Wish& wish : leaving[at(here)]) {
        const int more = static_cast<int>(level) + (wish.obstacle ? 1 : 0) + (avoided[at(wish.to)] ? 1 : 0);
        if (more >= reached[at(wish.to)].obstacles) continue;
        reached[at(wish.to)] = {more, here, wish.obstacle};
        if (waiting.size() <= static_cast<std::size_t>(more)) waiting.resize(static_cast<std::size_t>(more) + 1);
        waiting[static_cast<std::size_t>(more)].push_back(wish.to);
      }
    }
  }
  for (int place = to; place != from; place = reached[at(place)].before) {
    const Reached& last = reached[at(place)];
    const PlaceId& id = map.places[at(place)].id;
    if (avoided[at(place)]) why.obstacles.push_back({ObstacleKind::kAvoided, PlaceId(), id});
    if (last.over) why.obstacles.push_back({*last.over, map.places[at(last.before)].id, id});
  }
  std::ranges::reverse(why.obstacles);
  return why;
}

std::string no_route_text(const map::TopologicalMap& map, const RouteRequest& request) {
  const NoRoute why = explain_no_route(map, request);
  const auto name = [&](const PlaceId& id) { return named(*map::find_place(map, id)); };
  const std::string ways = "from " + name(request.from) + " to " + name(request.to);
  if (!why.connected) {
    return "No way " + ways + " was seen on a tour: the two are in parts of the map that are not connected.";
  }
  const auto open_back = [&](const Obstacle& way) {
    const map::Edge* back = map::find_edge(map, way.to, way.from);
    return back != nullptr && !back->blocked;
  };
  constexpr std::size_t kMostNamed = 5;
  std::vector<std::string> items;
  for (const Obstacle& obstacle : why.obstacles) {
    if (items.size() == kMostNamed) {
      items.push_back(std::to_string(why.obstacles.size() - kMostNamed) + " more");
      break;
    }
    const std::string way =
        "the way from " + (obstacle.from.empty() ? "" : name(obstacle.from)) + " to " + name(obstacle.to);
    switch (obstacle.kind) {
      case ObstacleKind::kBlocked:
        items.push_back(way + (open_back(obstacle) ? ", which is blocked in this direction" : ", which is blocked"));
        break;
      case ObstacleKind::kOneWay:
        items.push_back(way + ", which is one-way against it");
        break;
      case ObstacleKind::kClosed:
        items.push_back(way + ", which has just failed or is closed");
        break;
      case ObstacleKind::kAvoided:
        items.push_back("place " + name(obstacle.to) + ", which is to be avoided");
        break;
    }
  }
  return "There is no way " + ways + ": the freest leads over " + listed(items) + ".";
}

}  // namespace homeward::planning
