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
  return PathEdge{edge->bearing_rad, edge->turn_rad, metric ? std::optional(edge->length_m) : std::nullopt, edge->weak,
                  edge->shortcut};
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

void add_surroundings(const map::TopologicalMap& map, const map::MetricLayout& layout, std::span<const PlaceId> nearby,
                      MissionOrder& order) {
  constexpr double kMeasured_m = 0.15;
  constexpr double kGuessed_m = 0.6;
  const auto final_at = layout.find(order.final_image);
  if (final_at == layout.end()) return;
  Surroundings around;
  around.final_pose = final_at->second.map_from_robot;
  around.spread_m = final_at->second.metric ? kMeasured_m : kGuessed_m;
  const auto pose_of = [&](const ImageId& image) -> const map::LaidOutImage* {
    const auto at = layout.find(image);
    const bool known = at != layout.end() && at->second.component == final_at->second.component;
    return known ? &at->second : nullptr;
  };
  for (const PathPlace& step : order.path) {
    const map::LaidOutImage* at = pose_of(step.image);
    if (at == nullptr) return;
    around.path.push_back(at->map_from_robot);
    if (!at->metric) around.spread_m = kGuessed_m;
  }
  // A mission too long to be read would be worse than one that knows less. A quarter is left for all but appearances.
  constexpr std::size_t kMostBytes = kMaxLinkMessageBytes / 4 * 3;
  std::size_t bytes = order.final_appearance.size();
  for (const PathPlace& step : order.path) bytes += step.appearance.size();
  for (const PlaceId& id : nearby) {
    const map::Place& place = *map::find_place(map, id);
    const map::LaidOutImage* at = pose_of(place.prototype);
    if (at == nullptr) continue;
    std::vector<std::uint8_t> appearance = encode_appearance(place.appearances.front());
    bytes += appearance.size();
    if (bytes > kMostBytes) break;
    around.nearby.push_back({id, place.prototype, at->map_from_robot, std::move(appearance)});
  }
  order.surroundings = std::move(around);
}

}  // namespace homeward::wire
