// SPDX-License-Identifier: Apache-2.0
#include "planning/route.hpp"

#include <algorithm>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <boost/property_map/property_map.hpp>
#include <limits>

#include "map/graph.hpp"
#include "map/lookup.hpp"

namespace homeward::planning {
namespace {

struct Road {
  double cost_m = 0.0;
};
using RoadGraph = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, Road>;

std::string named(const map::Place& place) {
  return place.label.empty() ? place.id.str() : place.id.str() + " (" + place.label + ")";
}

/// Everything that may be driven: not blocked, not through places to avoid.
RoadGraph road_graph(const map::TopologicalMap& map, const std::vector<char>& avoided, double weak_edge_factor) {
  const auto index = map::place_indices(map);
  std::vector<std::pair<std::size_t, std::size_t>> ends;
  std::vector<Road> roads;
  for (const map::Edge& edge : map.edges) {
    const auto from = index.find(edge.from);
    const auto to = index.find(edge.to);
    if (edge.blocked || from == index.end() || to == index.end()) continue;
    const auto a = static_cast<std::size_t>(from->second);
    const auto b = static_cast<std::size_t>(to->second);
    if (avoided[a] || avoided[b]) continue;
    ends.emplace_back(a, b);
    roads.push_back({std::max(edge.length_m, 0.0) * (edge.weak ? std::max(weak_edge_factor, 1.0) : 1.0)});
  }
  return {boost::edges_are_unsorted_multi_pass, ends.begin(), ends.end(), roads.begin(), map.places.size()};
}

/// Whether edges lead from one place to the other when nothing is blocked or avoided.
bool connected_at_all(const map::TopologicalMap& map, int from, int to) {
  const map::PlaceGraph graph(map);
  const auto reached = map::reach(graph, from, graph.size());
  return std::ranges::any_of(reached, [&](const map::Reached& r) { return r.place == to; });
}

}  // namespace

Result<Route> plan_route(const map::TopologicalMap& map, const RouteRequest& request) {
  const map::Place* from = map::find_place(map, request.from);
  const map::Place* to = map::find_place(map, request.to);
  if (from == nullptr)
    return fail(ErrorCode::kUnknownPlace, "The map has no place " + request.from.str() + ".", "from");
  if (to == nullptr) return fail(ErrorCode::kUnknownPlace, "The map has no place " + request.to.str() + ".", "to");

  std::vector<char> avoided(map.places.size(), 0);
  for (const PlaceId& id : request.avoid) {
    const map::Place* place = map::find_place(map, id);
    if (place == nullptr) return fail(ErrorCode::kUnknownPlace, "The map has no place " + id.str() + ".", "avoid");
    avoided[static_cast<std::size_t>(place - map.places.data())] = 1;
  }
  const auto start = static_cast<std::size_t>(from - map.places.data());
  const auto goal = static_cast<std::size_t>(to - map.places.data());
  // Where the robot already stands cannot be avoided; a destination that is to be avoided is a contradiction.
  avoided[start] = 0;
  if (avoided[goal]) {
    return fail(ErrorCode::kNoRoute, "Place " + named(*to) + " is the destination and also to be avoided.", "avoid");
  }

  const RoadGraph roads = road_graph(map, avoided, request.weak_edge_factor);
  std::vector<std::size_t> before(map.places.size());
  std::vector<double> cost_m(map.places.size());
  const auto index = boost::get(boost::vertex_index, roads);
  boost::dijkstra_shortest_paths(roads, start,
                                 boost::weight_map(boost::get(&Road::cost_m, roads))
                                     .predecessor_map(boost::make_iterator_property_map(before.begin(), index))
                                     .distance_map(boost::make_iterator_property_map(cost_m.begin(), index))
                                     .distance_inf(std::numeric_limits<double>::infinity()));
  if (cost_m[goal] == std::numeric_limits<double>::infinity()) {
    const std::string ways = "from " + named(*from) + " to " + named(*to);
    if (connected_at_all(map, static_cast<int>(start), static_cast<int>(goal))) {
      return fail(ErrorCode::kNoRoute, "Every way " + ways + " leads over a blocked edge or through a place to avoid.",
                  request.to.str());
    }
    return fail(ErrorCode::kNoRoute,
                "No way " + ways + " was seen on a tour: the two are in parts of the map that are not connected.",
                request.to.str());
  }

  Route route;
  route.cost_m = cost_m[goal];
  for (std::size_t at = goal;; at = before[at]) {
    route.places.push_back(map.places[at].id);
    if (at == start) break;
  }
  std::ranges::reverse(route.places);
  return route;
}

}  // namespace homeward::planning
