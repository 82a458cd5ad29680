// SPDX-License-Identifier: Apache-2.0
#include "planning/roads.hpp"

#include <algorithm>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <boost/property_map/property_map.hpp>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "core/angles.hpp"
#include "core/index.hpp"
#include "map/lookup.hpp"

namespace homeward::planning {
namespace {

/// From the end of one edge to the end of the next.
struct Step {
  double cost = 0.0;
};
using StepGraph = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, Step>;

/// Without the rounds that a chain makes: from the last time that it leaves a place, not the first.
std::vector<int> without_rounds(const std::vector<int>& chain, const Roads& roads) {
  std::vector<int> straight;
  std::unordered_map<int, std::size_t> leaves_at;  // how many edges are kept before a place is left
  for (const int edge : chain) {
    const auto known = leaves_at.find(roads.from(edge));
    if (known != leaves_at.end()) {
      const std::size_t kept = known->second;  // what is erased next may hold it
      for (std::size_t i = kept; i < straight.size(); ++i) leaves_at.erase(roads.from(straight[i]));
      straight.resize(kept);
    }
    leaves_at[roads.from(edge)] = straight.size();
    straight.push_back(edge);
  }
  return straight;
}

}  // namespace

Roads::Roads(const map::TopologicalMap& map, const RouteRequest& request)
    : map_(map),
      by_(request.by),
      weak_edge_factor_(std::max(request.weak_edge_factor, 1.0)),
      travel_(request.travel),
      ends_(map.edges.size()),
      leaving_(map.places.size()) {
  const auto index = map::place_indices(map);
  for (std::size_t i = 0; i < map.edges.size(); ++i) {
    const map::Edge& edge = map.edges[i];
    const auto ends = map::ends_of(edge, index);
    if (edge.blocked || !ends) continue;
    ends_[i] = {ends->from, ends->to};
    leaving_[at(ends->from)].push_back(static_cast<int>(i));
  }
}

double Roads::seconds(int edge) const {
  const map::Edge& way = map_.edges[at(edge)];
  double speed_mps = travel_.speed_mps * (way.weak ? travel_.weak_speed_share : 1.0);
  if (way.shortcut || way.by == map::Decider::kPerson) speed_mps = std::min(speed_mps, travel_.shortcut_mps);
  return std::max(way.length_m, 0.0) / speed_mps;
}

double Roads::turn_seconds(int before, int after) const {
  const map::Edge& arrives = map_.edges[at(before)];
  const map::Edge& leaves = map_.edges[at(after)];
  if (!arrives.bearing_rad || !arrives.turn_rad || !leaves.bearing_rad) return 0.0;
  // The direction of travel on arrival, in the frame of the place where the two edges meet.
  const double heading_rad = *arrives.bearing_rad - *arrives.turn_rad;
  return std::abs(wrap_angle(*leaves.bearing_rad - heading_rad)) / travel_.turn_radps;
}

double Roads::weighted_m(int edge) const {
  const map::Edge& way = map_.edges[at(edge)];
  return std::max(way.length_m, 0.0) * (way.weak ? weak_edge_factor_ : 1.0);
}

double Roads::own_cost(int edge) const { return by_ == RouteCost::kTime ? seconds(edge) : weighted_m(edge); }

double Roads::turn_cost(int before, int after) const {
  return by_ == RouteCost::kTime ? turn_seconds(before, after) : 0.0;
}

double Roads::cost(std::span<const int> edges) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    sum += own_cost(edges[i]) + (i > 0 ? turn_cost(edges[i - 1], edges[i]) : 0.0);
  }
  return sum;
}

std::optional<std::vector<int>> Roads::cheapest(int from, std::optional<int> arrived_by, int to,
                                                std::span<const char> closed, std::span<const char> avoided) const {
  const auto usable = [&](int edge) {
    const Ends& ends = ends_[at(edge)];
    return ends.from >= 0 && !closed[at(edge)] && !avoided[at(ends.to)] && ends.to != from;
  };
  // Vertex e is the end of edge e; the last two are the start and the goal.
  const std::size_t start = map_.edges.size();
  const std::size_t goal = start + 1;
  std::vector<std::pair<std::size_t, std::size_t>> arcs;
  std::vector<Step> steps;
  const auto leave = [&](std::size_t vertex, int place, std::optional<int> by) {
    for (const int next : leaving_[at(place)]) {
      if (!usable(next)) continue;
      arcs.emplace_back(vertex, at(next));
      steps.push_back({own_cost(next) + (by ? turn_cost(*by, next) : 0.0)});
    }
  };
  leave(start, from, arrived_by);
  for (int edge = 0; edge < static_cast<int>(ends_.size()); ++edge) {
    if (!usable(edge)) continue;
    const int end = ends_[at(edge)].to;
    if (end == to) {
      arcs.emplace_back(at(edge), goal);
      steps.push_back({0.0});
    } else {
      leave(at(edge), end, edge);
    }
  }
  const StepGraph graph(boost::edges_are_unsorted_multi_pass, arcs.begin(), arcs.end(), steps.begin(), goal + 1);
  std::vector<std::size_t> before(goal + 1);
  std::vector<double> cost(goal + 1);
  const auto index = boost::get(boost::vertex_index, graph);
  boost::dijkstra_shortest_paths(graph, start,
                                 boost::weight_map(boost::get(&Step::cost, graph))
                                     .predecessor_map(boost::make_iterator_property_map(before.begin(), index))
                                     .distance_map(boost::make_iterator_property_map(cost.begin(), index))
                                     .distance_inf(std::numeric_limits<double>::infinity()));
  if (cost[goal] == std::numeric_limits<double>::infinity()) return std::nullopt;
  std::vector<int> chain;
  for (std::size_t vertex = before[goal]; vertex != start; vertex = before[vertex]) {
    chain.push_back(static_cast<int>(vertex));
  }
  std::ranges::reverse(chain);
  // Where turns are not known a round may seem to save a sharp one.
  return without_rounds(chain, *this);
}

}  // namespace homeward::planning
