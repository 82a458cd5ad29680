// SPDX-License-Identifier: Apache-2.0
#include "mapping/tour_steps.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <utility>

#include "map/lookup.hpp"

namespace homeward::mapping {
namespace {

using map::MapImage;
using map::Place;
using map::TopologicalMap;

constexpr double kLeast_m = 0.05;
constexpr double kLongest_images = 60;  // a tour that went another way in between tells no length

std::optional<double> odometry_m(const TopologicalMap& map, std::size_t first, std::size_t last) {
  double sum_m = 0.0;
  for (std::size_t i = first; i <= last; ++i) {
    if (!map.images[i].odometry) return std::nullopt;
    if (i == first) continue;
    const Pose2& before = *map.images[i - 1].odometry;
    const Pose2& after = *map.images[i].odometry;
    sum_m += std::hypot(after.x_m - before.x_m, after.y_m - before.y_m);
  }
  return sum_m;
}

/// The length between the prototypes of two places; an edge of unknown length where no tour tells it.
map::Edge unseen_edge(const TopologicalMap& map, const Place& a, const Place& b) {
  map::Edge edge;
  edge.weak = true;
  const auto position = [&](const ImageId& image) {
    return static_cast<std::size_t>(std::ranges::find(map.images, image, &MapImage::id) - map.images.begin());
  };
  const auto [first, last] = std::minmax({position(a.prototype), position(b.prototype)});
  const bool one_tour = map::tour_name(a.prototype) == map::tour_name(b.prototype);
  if (!one_tour || last >= map.images.size() || static_cast<double>(last - first) > kLongest_images) return edge;
  if (const auto length_m = odometry_m(map, first, last)) {
    edge.length_m = std::max(*length_m, kLeast_m);
    edge.length_from = map::LengthSource::kOdometry;
  } else {
    edge.length_m = static_cast<double>(last - first);
    edge.length_from = map::LengthSource::kTourImages;
  }
  return edge;
}

}  // namespace

std::set<PlaceId> driven_from(const TopologicalMap& map, const Place& place) {
  const std::set<ImageId> own(place.members.begin(), place.members.end());
  std::set<ImageId> beside;
  const auto step = [&](const MapImage& from, const MapImage& to) {
    if (own.contains(from.id) == own.contains(to.id)) return;
    if (map::tour_name(from.id) == map::tour_name(to.id)) beside.insert(own.contains(from.id) ? to.id : from.id);
  };
  for (std::size_t i = 1; i < map.images.size(); ++i) step(map.images[i - 1], map.images[i]);
  std::set<PlaceId> places;
  for (const Place& other : map.places) {
    const bool holds = std::ranges::any_of(other.members, [&](const ImageId& image) { return beside.contains(image); });
    if (holds && other.id != place.id) places.insert(other.id);
  }
  return places;
}

void join_both_ways(TopologicalMap& map, const PlaceId& a, const PlaceId& b, map::Decider by) {
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
    if (map::find_edge(map, from, to) != nullptr) continue;
    map::Edge edge = unseen_edge(map, *map::find_place(map, a), *map::find_place(map, b));
    edge.from = from;
    edge.to = to;
    edge.by = by;
    map.edges.push_back(edge);
  }
}

}  // namespace homeward::mapping
