// SPDX-License-Identifier: Apache-2.0
#include "map/graph.hpp"

#include <algorithm>
#include <numeric>

#include "map/lookup.hpp"

namespace homeward::map {
namespace {

int root_of(std::vector<int>& parents, int node) {
  while (parents[static_cast<std::size_t>(node)] != node) {
    int& parent = parents[static_cast<std::size_t>(node)];
    parent = parents[static_cast<std::size_t>(parent)];
    node = parent;
  }
  return node;
}

}  // namespace

PlaceGraph::PlaceGraph(const TopologicalMap& map) : outgoing_(map.places.size()) {
  const auto index = place_indices(map);
  for (std::size_t i = 0; i < map.edges.size(); ++i) {
    const auto ends = ends_of(map.edges[i], index);
    if (!ends) continue;
    outgoing_[static_cast<std::size_t>(ends->from)].push_back({ends->to, static_cast<int>(i)});
  }
}

std::vector<int> components(const PlaceGraph& graph) {
  std::vector<int> parents(static_cast<std::size_t>(graph.size()));
  std::iota(parents.begin(), parents.end(), 0);
  for (int place = 0; place < graph.size(); ++place) {
    for (const Arc& arc : graph.arcs_from(place)) {
      const int a = root_of(parents, place);
      const int b = root_of(parents, arc.to);
      parents[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
  }
  std::vector<int> numbers(parents.size(), -1);
  int next = 0;
  for (int place = 0; place < graph.size(); ++place) {
    const auto root = static_cast<std::size_t>(root_of(parents, place));
    if (numbers[root] < 0) numbers[root] = next++;
    numbers[static_cast<std::size_t>(place)] = numbers[root];
  }
  return numbers;
}

std::vector<Reached> reach(const PlaceGraph& graph, int from, int max_hops) {
  std::vector<Reached> reached{{from, 0}};
  std::vector<char> seen(static_cast<std::size_t>(graph.size()), 0);
  seen[static_cast<std::size_t>(from)] = 1;
  for (std::size_t next = 0, level_begin = 0; next < reached.size(); ++next) {
    const Reached here = reached[next];
    if (here.hops == max_hops) continue;
    for (const Arc& arc : graph.arcs_from(here.place)) {
      char& flag = seen[static_cast<std::size_t>(arc.to)];
      if (flag) continue;
      flag = 1;
      reached.push_back({arc.to, here.hops + 1});
    }
    const bool level_ends = next + 1 < reached.size() && reached[next + 1].hops > here.hops;
    if (level_ends) {
      level_begin = next + 1;
      std::sort(reached.begin() + static_cast<std::ptrdiff_t>(level_begin), reached.end(),
                [](const Reached& a, const Reached& b) { return a.place < b.place; });
    }
  }
  return reached;
}

}  // namespace homeward::map
