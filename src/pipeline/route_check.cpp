// SPDX-License-Identifier: Apache-2.0
#include "pipeline/route_check.hpp"

#include <algorithm>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

namespace homeward::pipeline {
namespace {

using map::TopologicalMap;

/// Everywhere that open ways lead to from a place, itself included.
std::set<PlaceId> reached_from(const std::unordered_map<PlaceId, std::vector<PlaceId>>& ways, const PlaceId& place) {
  std::set<PlaceId> reached{place};
  std::vector<PlaceId> next{place};
  while (!next.empty()) {
    const PlaceId here = next.back();
    next.pop_back();
    const auto out = ways.find(here);
    if (out == ways.end()) continue;
    for (const PlaceId& there : out->second) {
      if (reached.insert(there).second) next.push_back(there);
    }
  }
  return reached;
}

/// Ordered pairs of destinations, by their pictures, with an open way.
std::set<std::pair<ImageId, ImageId>> routes(const TopologicalMap& map) {
  std::unordered_map<PlaceId, std::vector<PlaceId>> ways;
  for (const map::Edge& edge : map.edges) {
    if (!edge.blocked) ways[edge.from].push_back(edge.to);
  }
  std::set<std::pair<ImageId, ImageId>> found;
  for (const map::Destination& from : map.destinations) {
    const std::set<PlaceId> reached = reached_from(ways, from.place);
    for (const map::Destination& to : map.destinations) {
      if (from.image != to.image && reached.contains(to.place)) found.emplace(from.image, to.image);
    }
  }
  return found;
}

}  // namespace

void check_routes(const TopologicalMap& before, const TopologicalMap& after, map::ReplayCheck& check) {
  const auto old = routes(before);
  const auto now = routes(after);
  check.routes_before = static_cast<int>(old.size());
  check.routes_after = static_cast<int>(now.size());
  const auto place_of = [&](const ImageId& image) {
    const auto found = std::ranges::find(after.destinations, image, &map::Destination::image);
    return found == after.destinations.end() ? PlaceId() : found->place;
  };
  std::set<std::pair<ImageId, ImageId>> told;
  for (const auto& [from, to] : old) {
    if (now.contains({from, to}) || place_of(from).empty() || place_of(to).empty()) continue;
    if (!told.insert(std::minmax(from, to)).second) continue;
    check.worse.push_back({map::Worsening::kRoute, place_of(from), place_of(to), {from, to}, 2, 0, 0.0});
  }
}

}  // namespace homeward::pipeline
