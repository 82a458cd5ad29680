// SPDX-License-Identifier: Apache-2.0
#include "wire/mission_order.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include "map/lookup.hpp"
#include "wire/appearance_blob.hpp"

namespace homeward::wire {
namespace {

std::optional<PathEdge> edge_between(const map::TopologicalMap& map, const PlaceId& from, const PlaceId& to) {
  const map::Edge* edge = map::find_edge(map, from, to);
  if (edge == nullptr) return std::nullopt;
  // A robot that counts on a length needs a measured one.
  const bool metric = edge->length_from == map::LengthSource::kOdometry;
  return PathEdge{edge->bearing_rad, edge->turn_rad, metric ? std::optional(edge->length_m) : std::nullopt, edge->weak,
                  edge->shortcut || edge->by == map::Decider::kPerson};
}

/// The ways between the views that an order tells of which a tour drove and which are open, each once: what is closed
/// now may well be barred by a surface. Of a length that nobody measured, nobody knows whether it was driven straight.
std::vector<std::array<int, 2>> driven_ways(const map::TopologicalMap& map, const MissionOrder& order,
                                            const Surroundings& around) {
  constexpr double kLongest_m = 2.5;  // a longer one is no straight piece
  std::map<PlaceId, int> numbers;
  std::vector<Eigen::Vector2d> at_m;
  for (std::size_t i = 0; i < order.path.size(); ++i) numbers.emplace(order.path[i].place, static_cast<int>(i));
  for (const Pose2& pose : around.path) at_m.emplace_back(pose.x_m, pose.y_m);
  for (const PlacedView& view : around.nearby) {
    numbers.emplace(view.place, static_cast<int>(at_m.size()));
    at_m.emplace_back(view.map_from_view.x_m, view.map_from_view.y_m);
  }
  std::set<std::array<int, 2>> ways;
  std::set<std::array<int, 2>> closed;
  for (const map::Edge& edge : map.edges) {
    const auto from = numbers.find(edge.from);
    const auto to = numbers.find(edge.to);
    if (from == numbers.end() || to == numbers.end()) continue;
    const auto [first, second] = std::minmax(from->second, to->second);
    const bool driven = !edge.shortcut && edge.length_from == map::LengthSource::kOdometry;
    const double length_m = (at_m[static_cast<std::size_t>(second)] - at_m[static_cast<std::size_t>(first)]).norm();
    if (edge.blocked) closed.insert({first, second});
    if (driven && length_m <= kLongest_m) ways.insert({first, second});
  }
  std::vector<std::array<int, 2>> open;
  std::ranges::set_difference(ways, closed, std::back_inserter(open));
  open.resize(std::min(open.size(), Surroundings::kMostWays));
  return open;
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

bool drawn_by_a_person(const map::TopologicalMap& map, const PlaceId& from, const PlaceId& to) {
  const map::Edge* edge = map::find_edge(map, from, to);
  return edge != nullptr && edge->by == map::Decider::kPerson && !edge->shortcut;
}

void confirm_way(const PlaceId& from, const PlaceId& to, MissionOrder& order) {
  for (std::size_t i = 0; i + 1 < order.path.size(); ++i) {
    PathPlace& step = order.path[i];
    if (step.place == from && order.path[i + 1].place == to && step.next) step.next->shortcut = false;
  }
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
  around.ways = driven_ways(map, order, around);
  order.surroundings = std::move(around);
}

void leave_out_way(const PlaceId& from, const PlaceId& to, MissionOrder& order) {
  if (!order.surroundings) return;
  const auto place = [&](int view) -> const PlaceId& {
    const auto number = static_cast<std::size_t>(view);
    return number < order.path.size() ? order.path[number].place
                                      : order.surroundings->nearby[number - order.path.size()].place;
  };
  std::erase_if(order.surroundings->ways, [&](const std::array<int, 2>& way) {
    const PlaceId& first = place(way[0]);
    const PlaceId& second = place(way[1]);
    return (first == from && second == to) || (first == to && second == from);
  });
}

}  // namespace homeward::wire
