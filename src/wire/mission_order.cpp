// SPDX-License-Identifier: Apache-2.0
#include "wire/mission_order.hpp"

#include <algorithm>

#include "map/lookup.hpp"
#include "wire/appearance_blob.hpp"

namespace homeward::wire {
namespace {

std::optional<PathEdge> edge_between(const map::TopologicalMap& map, const PlaceId& from, const PlaceId& to) {
  const auto edge = std::find_if(map.edges.begin(), map.edges.end(), [&](const map::Edge& candidate) {
    return candidate.from == from && candidate.to == to;
  });
  if (edge == map.edges.end()) return std::nullopt;
  // A robot that counts on a length needs a measured one.
  const bool metric = edge->length_from == map::LengthSource::kOdometry;
  return PathEdge{edge->bearing_rad, edge->turn_rad, metric ? std::optional(edge->length_m) : std::nullopt, edge->weak};
}

}  // namespace

MissionOrder order_for_route(const map::TopologicalMap& map, std::span<const PlaceId> route) {
  MissionOrder order;
  order.revision = map.revision;
  order.feature_config_id = map.feature_config_id;
  for (std::size_t i = 0; i < route.size(); ++i) {
    const map::Place& place = *map::find_place(map, route[i]);
    PathPlace step{place.id, place.prototype, encode_appearance(place.appearances.front()), std::nullopt};
    if (i + 1 < route.size()) step.next = edge_between(map, route[i], route[i + 1]);
    order.path.push_back(std::move(step));
  }
  order.final_image = order.path.back().image;
  order.final_appearance = order.path.back().appearance;
  order.label = map::find_place(map, route.back())->label;
  return order;
}

MissionOrder order_for_route(const map::TopologicalMap& map, std::span<const PlaceId> route,
                             const map::Destination& destination) {
  MissionOrder order = order_for_route(map, route);
  order.final_image = destination.image;
  order.final_appearance = encode_appearance(destination.appearance);
  order.label = destination.label;
  order.dock = true;
  return order;
}

}  // namespace homeward::wire
