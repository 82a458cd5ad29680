// SPDX-License-Identifier: Apache-2.0
#include "planning/route.hpp"

#include <algorithm>
#include <set>
#include <string>

#include "core/index.hpp"
#include "map/lookup.hpp"
#include "planning/no_route.hpp"
#include "planning/roads.hpp"

namespace homeward::planning {
namespace {

constexpr int kMostRoutes = 100;

/// A request in indices.
struct Task {
  int from = 0;
  int to = 0;
  std::vector<char> closed;   // of each edge
  std::vector<char> avoided;  // of each place
};

Result<int> index_of(const map::TopologicalMap& map, const PlaceId& id, const char* where) {
  const map::Place* place = map::find_place(map, id);
  if (place == nullptr) return fail(ErrorCode::kUnknownPlace, "The map has no place " + id.str() + ".", where);
  return static_cast<int>(place - map.places.data());
}

Result<Task> task_of(const map::TopologicalMap& map, const RouteRequest& request) {
  const auto from = index_of(map, request.from, "from");
  if (!from) return pass_on(from);
  const auto to = index_of(map, request.to, "to");
  if (!to) return pass_on(to);
  const TravelModel& travel = request.travel;
  if (!(travel.speed_mps > 0.0) || !(travel.turn_radps > 0.0) || !(travel.weak_speed_share > 0.0) ||
      !(travel.shortcut_mps > 0.0)) {
    return fail(ErrorCode::kInvalidInput, "Speeds of travel must be above 0.", "travel");
  }
  Task task{*from, *to, std::vector<char>(map.edges.size(), 0), std::vector<char>(map.places.size(), 0)};
  for (const PlaceId& id : request.avoid) {
    const auto place = index_of(map, id, "avoid");
    if (!place) return pass_on(place);
    task.avoided[at(*place)] = 1;
  }
  for (const Way& way : request.closed) {
    for (const PlaceId& id : {way.from, way.to}) {
      if (const auto place = index_of(map, id, "closed"); !place) return pass_on(place);
    }
    for (std::size_t i = 0; i < map.edges.size(); ++i) {
      if (map.edges[i].from == way.from && map.edges[i].to == way.to) task.closed[i] = 1;
    }
  }
  // Where the robot already stands cannot be avoided; a destination that is to be avoided is a contradiction.
  task.avoided[at(task.from)] = 0;
  if (task.avoided[at(task.to)]) {
    return fail(ErrorCode::kNoRoute,
                "Place " + named(map.places[at(task.to)]) + " is the destination and also to be avoided.", "avoid");
  }
  return task;
}

Route route_along(const map::TopologicalMap& map, const Roads& roads, int from, const std::vector<int>& chain) {
  Route route;
  route.places.push_back(map.places[at(from)].id);
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const map::Edge& edge = map.edges[at(chain[i])];
    route.places.push_back(edge.to);
    route.cost_m += roads.weighted_m(chain[i]);
    route.length_m += std::max(edge.length_m, 0.0);
    route.time_s += roads.seconds(chain[i]) + (i > 0 ? roads.turn_seconds(chain[i - 1], chain[i]) : 0.0);
    if (edge.weak) route.weak.push_back({edge.from, edge.to});
    if (edge.shortcut) route.shortcuts.push_back({edge.from, edge.to});
    const bool unknown = edge.length_from == map::LengthSource::kUnknown;
    if (route.length_from != map::LengthSource::kUnknown) {
      route.length_from = unknown ? edge.length_from : std::max(route.length_from, edge.length_from);
    }
  }
  return route;
}

/// Yen's algorithm: each next way leaves one of those found at some place, over an edge that none of them takes there.
std::vector<std::vector<int>> cheapest_chains(const Roads& roads, const Task& task, int count) {
  std::vector<std::vector<int>> found;
  const auto first = roads.cheapest(task.from, std::nullopt, task.to, task.closed, task.avoided);
  if (!first) return found;
  found.push_back(*first);
  std::set<std::pair<double, std::vector<int>>> waiting;  // by cost
  while (static_cast<int>(found.size()) < count) {
    const std::vector<int> last = found.back();
    std::vector<char> avoided = task.avoided;
    for (std::size_t kept = 0; kept < last.size(); ++kept) {
      std::vector<char> closed = task.closed;
      for (const std::vector<int>& other : found) {
        if (other.size() > kept &&
            std::equal(last.begin(), last.begin() + static_cast<std::ptrdiff_t>(kept), other.begin())) {
          closed[at(other[kept])] = 1;
        }
      }
      const int here = roads.from(last[kept]);
      const auto arrived_by = kept > 0 ? std::optional(last[kept - 1]) : std::nullopt;
      const auto rest = roads.cheapest(here, arrived_by, task.to, closed, avoided);
      avoided[at(here)] = 1;
      if (!rest) continue;
      std::vector<int> chain(last.begin(), last.begin() + static_cast<std::ptrdiff_t>(kept));
      chain.insert(chain.end(), rest->begin(), rest->end());
      const double cost = roads.cost(chain);
      waiting.emplace(cost, std::move(chain));
    }
    if (waiting.empty()) break;
    found.push_back(waiting.begin()->second);
    waiting.erase(waiting.begin());
  }
  return found;
}

}  // namespace

Result<Route> plan_route(const map::TopologicalMap& map, const RouteRequest& request) {
  auto routes = plan_routes(map, request, 1);
  if (!routes) return pass_on(routes);
  return std::move(routes->front());
}

Result<std::vector<Route>> plan_routes(const map::TopologicalMap& map, const RouteRequest& request, int count) {
  if (count < 1 || count > kMostRoutes) {
    return fail(ErrorCode::kInvalidInput, "Between 1 and " + std::to_string(kMostRoutes) + " routes can be asked for.",
                "count");
  }
  const auto task = task_of(map, request);
  if (!task) return pass_on(task);
  const Roads roads(map, request);
  std::vector<Route> routes;
  if (task->from == task->to) {
    routes.push_back(route_along(map, roads, task->from, {}));
    return routes;
  }
  for (const std::vector<int>& chain : cheapest_chains(roads, *task, count)) {
    routes.push_back(route_along(map, roads, task->from, chain));
  }
  if (routes.empty()) return fail(ErrorCode::kNoRoute, no_route_text(map, request), request.to.str());
  return routes;
}

}  // namespace homeward::planning
