// SPDX-License-Identifier: Apache-2.0
#include "mapping/identity.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "map/taught_path.hpp"

namespace homeward::mapping {
namespace {

/// A place whose id may be used again, as it was when these images made it up.
struct OldPlace {
  PlaceId id;
  std::vector<ImageId> images;
};

/// A place of the previous map counts as it was without edits, and without the images of which edits made places of
/// their own; those places as they are.
std::vector<OldPlace> old_places(const map::TopologicalMap& previous) {
  std::vector<OldPlace> old;
  if (!previous.unedited) {
    for (const map::Place& place : previous.places) old.push_back({place.id, place.members});
    return old;
  }
  std::unordered_set<PlaceId> unedited;
  for (const map::Place& place : previous.unedited->places) {
    unedited.insert(place.id);
    old.push_back({place.id, place.members});
  }
  std::unordered_set<ImageId> of_made_places;
  for (const map::Place& place : previous.places) {
    if (unedited.contains(place.id)) continue;
    old.push_back({place.id, place.members});
    of_made_places.insert(place.members.begin(), place.members.end());
  }
  for (const map::Place& place : previous.unedited->places) {
    OldPlace left{place.id, {}};
    for (const ImageId& image : place.members) {
      if (!of_made_places.contains(image)) left.images.push_back(image);
    }
    if (left.images.size() < place.members.size()) old.push_back(std::move(left));
  }
  return old;
}

struct Overlap {
  double share = 0.0;  // of the images of either that both have
  int fresh = 0;       // index of a new place
  int old = 0;         // index of an old one
};

/// Pairs of new and old places that share images, most alike first.
std::vector<Overlap> overlaps(const map::TopologicalMap& map, const std::vector<OldPlace>& old_places) {
  std::unordered_map<ImageId, int> fresh_place_of;
  for (std::size_t fresh = 0; fresh < map.places.size(); ++fresh) {
    for (const ImageId& image : map.places[fresh].members) fresh_place_of.emplace(image, static_cast<int>(fresh));
  }
  std::vector<Overlap> result;
  for (std::size_t old = 0; old < old_places.size(); ++old) {
    std::map<int, int> shared;
    for (const ImageId& image : old_places[old].images) {
      const auto fresh = fresh_place_of.find(image);
      if (fresh != fresh_place_of.end()) ++shared[fresh->second];
    }
    for (const auto& [fresh, images] : shared) {
      const std::size_t all =
          old_places[old].images.size() + map.places[static_cast<std::size_t>(fresh)].members.size();
      const double either = static_cast<double>(all) - images;
      result.push_back({images / either, fresh, static_cast<int>(old)});
    }
  }
  std::ranges::stable_sort(result, [](const Overlap& a, const Overlap& b) { return a.share > b.share; });
  return result;
}

std::vector<PlaceId> lasting_place_ids(const map::TopologicalMap& map, const map::TopologicalMap* previous,
                                       std::int64_t& next_number) {
  std::vector<PlaceId> ids(map.places.size());
  if (previous != nullptr) {
    const std::vector<OldPlace> old = old_places(*previous);
    std::unordered_set<PlaceId> taken;
    for (const Overlap& overlap : overlaps(map, old)) {
      PlaceId& id = ids[static_cast<std::size_t>(overlap.fresh)];
      const PlaceId& known = old[static_cast<std::size_t>(overlap.old)].id;
      if (id.empty() && taken.insert(known).second) id = known;
    }
  }
  for (PlaceId& id : ids) {
    if (id.empty()) id = PlaceId("p" + std::to_string(next_number++));
  }
  return ids;
}

/// Whether the map has the pictures that a path is made of.
bool holds_path(const map::TopologicalMap& map, const std::shared_ptr<const map::MapPath>& path) {
  if (!path) return false;
  std::unordered_set<ImageId> images;
  for (const map::MapImage& image : map.images) images.insert(image.id);
  return std::ranges::all_of(path->images, [&](const ImageId& image) { return images.contains(image); });
}

}  // namespace

void keep_identity(map::TopologicalMap& map, const map::TopologicalMap* previous) {
  if (previous != nullptr) {
    if (holds_path(map, previous->path)) map.path = previous->path;
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
      const auto& all = previous->unedited ? previous->unedited->destinations : previous->destinations;
      const auto old = std::ranges::find(all, destination.image, &map::Destination::image);
      if (old != all.end()) destination.id = old->id;
    }
    if (destination.id.empty()) destination.id = DestinationId("d" + std::to_string(map.next_destination_number++));
  }
}

}  // namespace homeward::mapping
