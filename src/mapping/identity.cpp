// SPDX-License-Identifier: Apache-2.0
#include "mapping/identity.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <unordered_map>
#include <vector>

namespace homeward::mapping {
namespace {

struct Overlap {
  int images = 0;
  int fresh = 0;  // index of a new place
  int old = 0;    // index of a place of the previous map
};

/// Pairs of new and old places that share images, most shared first.
std::vector<Overlap> overlaps(const map::TopologicalMap& map, const map::TopologicalMap& previous) {
  std::unordered_map<ImageId, int> old_place_of;
  for (std::size_t old = 0; old < previous.places.size(); ++old) {
    for (const ImageId& image : previous.places[old].members) old_place_of.emplace(image, static_cast<int>(old));
  }
  std::map<std::pair<int, int>, int> shared;
  for (std::size_t fresh = 0; fresh < map.places.size(); ++fresh) {
    for (const ImageId& image : map.places[fresh].members) {
      const auto old = old_place_of.find(image);
      if (old != old_place_of.end()) ++shared[{static_cast<int>(fresh), old->second}];
    }
  }
  std::vector<Overlap> result;
  result.reserve(shared.size());
  for (const auto& [pair, images] : shared) result.push_back({images, pair.first, pair.second});
  std::ranges::stable_sort(result, [](const Overlap& a, const Overlap& b) { return a.images > b.images; });
  return result;
}

std::vector<PlaceId> lasting_place_ids(const map::TopologicalMap& map, const map::TopologicalMap* previous,
                                       std::int64_t& next_number) {
  std::vector<PlaceId> ids(map.places.size());
  if (previous != nullptr) {
    std::vector<char> taken(previous->places.size(), 0);
    for (const Overlap& overlap : overlaps(map, *previous)) {
      PlaceId& id = ids[static_cast<std::size_t>(overlap.fresh)];
      char& used = taken[static_cast<std::size_t>(overlap.old)];
      if (!id.empty() || used) continue;
      id = previous->places[static_cast<std::size_t>(overlap.old)].id;
      used = 1;
    }
  }
  for (PlaceId& id : ids) {
    if (id.empty()) id = PlaceId("p" + std::to_string(next_number++));
  }
  return ids;
}

}  // namespace

void keep_identity(map::TopologicalMap& map, const map::TopologicalMap* previous) {
  if (previous != nullptr) {
    map.next_place_number = previous->next_place_number;
    map.next_destination_number = previous->next_destination_number;
  }
  const std::vector<PlaceId> ids = lasting_place_ids(map, previous, map.next_place_number);
  std::unordered_map<PlaceId, PlaceId> lasting;
  for (std::size_t i = 0; i < map.places.size(); ++i) {
    lasting.emplace(map.places[i].id, ids[i]);
    map.places[i].id = ids[i];
  }
  for (map::Edge& edge : map.edges) {
    edge.from = lasting.at(edge.from);
    edge.to = lasting.at(edge.to);
  }
  for (map::Destination& destination : map.destinations) {
    destination.place = lasting.at(destination.place);
    destination.id = {};
    if (previous != nullptr) {
      const auto old = std::ranges::find(previous->destinations, destination.image, &map::Destination::image);
      if (old != previous->destinations.end()) destination.id = old->id;
    }
    if (destination.id.empty()) destination.id = DestinationId("d" + std::to_string(map.next_destination_number++));
  }
}

}  // namespace homeward::mapping
