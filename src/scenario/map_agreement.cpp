// SPDX-License-Identifier: Apache-2.0
#include "scenario/map_agreement.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include "map/lookup.hpp"

namespace homeward::scenario {
namespace {

int apart_in(const std::vector<Eigen::Vector2d>& at_m) {
  constexpr double kFar_m = 4.0;
  return static_cast<int>(std::ranges::count_if(at_m, [&](const Eigen::Vector2d& one) {
    return std::ranges::any_of(at_m, [&](const Eigen::Vector2d& other) { return (other - one).norm() > kFar_m; });
  }));
}

}  // namespace

MapAgreement map_agreement(const map::TopologicalMap& map, const ExploredGraph& explored) {
  MapAgreement agreement;
  std::unordered_map<ImageId, std::size_t> number;
  for (std::size_t i = 0; i < explored.images.size(); ++i) number.emplace(explored.images[i], i);
  std::vector<std::optional<std::size_t>> place_of(explored.images.size());
  for (std::size_t p = 0; p < map.places.size(); ++p) {
    std::vector<Eigen::Vector2d> at_m;
    for (const ImageId& member : map.places[p].members) {
      const auto known = number.find(member);
      if (known == number.end()) continue;
      place_of[known->second] = p;
      at_m.push_back(position_m(explored.poses[known->second]));
    }
    agreement.apart_in_map += apart_in(at_m);
  }

  const std::unordered_map<PlaceId, int> indices = map::place_indices(map);
  std::set<std::pair<std::size_t, std::size_t>> joined;
  for (const map::Edge& edge : map.edges) {
    const auto ends = map::ends_of(edge, indices);
    if (!ends) continue;
    joined.emplace(static_cast<std::size_t>(std::min(ends->from, ends->to)),
                   static_cast<std::size_t>(std::max(ends->from, ends->to)));
  }
  for (const exploration::KnownAgain& known : explored.known_again) {
    const auto now = place_of[static_cast<std::size_t>(known.now)];
    const auto then = place_of[static_cast<std::size_t>(known.then)];
    if (known.taken_back || !now || !then || *now == *then) continue;
    agreement.missed_by_map += joined.contains({std::min(*now, *then), std::max(*now, *then)}) ? 0 : 1;
  }
  return agreement;
}

}  // namespace homeward::scenario
