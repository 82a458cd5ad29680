// SPDX-License-Identifier: Apache-2.0
#include "mapping/place_edits.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "map/lookup.hpp"

namespace homeward::mapping {
namespace {

using map::Place;
using map::TopologicalMap;

/// Order in the tour, for members.
void sort_members(const TopologicalMap& map, Place& place) {
  const auto index = map::image_indices(map);
  std::ranges::sort(place.members, {}, [&](const ImageId& id) {
    const auto found = index.find(id);
    return found == index.end() ? static_cast<int>(index.size()) : found->second;
  });
}

/// Drops edges that lead from a place to itself or nowhere, and keeps one edge for each pair and direction.
void tidy_edges(TopologicalMap& map) {
  const auto index = map::place_indices(map);
  std::set<std::pair<PlaceId, PlaceId>> seen;
  std::ranges::stable_partition(map.edges, [](const map::Edge& edge) { return !edge.shortcut; });
  std::erase_if(map.edges, [&](const map::Edge& edge) {
    if (edge.from == edge.to || !index.contains(edge.from) || !index.contains(edge.to)) return true;
    return !seen.emplace(edge.from, edge.to).second;
  });
}

void redirect(TopologicalMap& map, const PlaceId& gone, const PlaceId& kept) {
  for (map::Edge& edge : map.edges) {
    // Bearings belong to the prototype of the place that goes.
    if (edge.from != gone && edge.to != gone) continue;
    edge.bearing_rad.reset();
    edge.turn_rad.reset();
    edge.confidence = 0.0;
    edge.inliers = 0;
    edge.weak = true;
    if (edge.from == gone) edge.from = kept;
    if (edge.to == gone) edge.to = kept;
  }
  for (map::Destination& destination : map.destinations) {
    if (destination.place == gone) destination.place = kept;
  }
  tidy_edges(map);
}

/// Takes images out of a place. A place keeps at least its prototype.
Status take_out(Place& place, const std::vector<ImageId>& images) {
  for (const ImageId& image : images) {
    if (image == place.prototype) {
      return fail(
          ErrorCode::kInvalidInput,
          "The image " + image.str() + " is the prototype of place " + place.id.str() + " and has to stay there.",
          image.str());
    }
    if (std::ranges::find(place.members, image) == place.members.end()) {
      return fail(ErrorCode::kNotFound, "Place " + place.id.str() + " does not hold the image " + image.str() + ".",
                  image.str());
    }
  }
  std::erase_if(place.members, [&](const ImageId& id) { return std::ranges::find(images, id) != images.end(); });
  return {};
}

}  // namespace

tl::unexpected<Error> no_place_with(const ImageId& image) {
  return fail(ErrorCode::kNotFound, "No place of the map holds the image " + image.str() + ".", image.str());
}

void join_both_ways(TopologicalMap& map, const PlaceId& a, const PlaceId& b, map::Decider by) {
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)}) {
    if (map::find_edge(map, from, to) != nullptr) continue;
    map::Edge edge;
    edge.from = from;
    edge.to = to;
    edge.weak = true;
    edge.by = by;
    map.edges.push_back(edge);
  }
}

Status merge_places(TopologicalMap& map, const ImageId& image_a, const ImageId& image_b) {
  Place* kept = map::find_place_of(map, image_a);
  const Place* gone = map::find_place_of(map, image_b);
  if (kept == nullptr) return no_place_with(image_a);
  if (gone == nullptr) return no_place_with(image_b);
  if (kept == gone) return fail(ErrorCode::kInvalidInput, "Both images are in place " + kept->id.str() + " already.");
  kept->members.insert(kept->members.end(), gone->members.begin(), gone->members.end());
  kept->appearances.insert(kept->appearances.end(), gone->appearances.begin(), gone->appearances.end());
  if (kept->label.empty()) kept->label = gone->label;
  sort_members(map, *kept);
  const PlaceId kept_id = kept->id;
  const PlaceId gone_id = gone->id;
  std::erase_if(map.places, [&](const Place& place) { return place.id == gone_id; });
  redirect(map, gone_id, kept_id);
  return {};
}

Status split_place(TopologicalMap& map, const ImageId& image_a, const std::vector<ImageId>& named) {
  const std::set<ImageId> once(named.begin(), named.end());
  const std::vector<ImageId> images(once.begin(), once.end());
  Place* old_place = map::find_place_of(map, image_a);
  if (old_place == nullptr) return no_place_with(image_a);
  if (images.empty()) return fail(ErrorCode::kInvalidInput, "A split has to name the images that leave.", "images");
  if (const Status taken = take_out(*old_place, images); !taken) return taken;
  Place fresh;
  fresh.id = PlaceId("p" + std::to_string(map.next_place_number++));
  fresh.members = images;
  sort_members(map, fresh);
  // Appearances of members are not kept, only those of prototypes: until the map is rebuilt the new place looks like
  // the old one.
  fresh.prototype = fresh.members[fresh.members.size() / 2];
  fresh.appearances = {old_place->appearances.front()};
  const PlaceId old_id = old_place->id;
  const PlaceId fresh_id = fresh.id;
  map.places.push_back(std::move(fresh));
  for (map::Destination& destination : map.destinations) {
    if (std::ranges::find(images, destination.image) != images.end()) destination.place = fresh_id;
  }
  // The tour leads on from the last image that left to the next one that stayed, or to another place.
  const auto index = map::image_indices(map);
  for (const ImageId& image : images) {
    const int at = index.at(image);
    for (const int next : {at - 1, at + 1}) {
      if (next < 0 || next >= static_cast<int>(map.images.size())) continue;
      const Place* neighbour = map::find_place_of(map, map.images[static_cast<std::size_t>(next)].id);
      if (neighbour != nullptr && neighbour->id != fresh_id)
        join_both_ways(map, fresh_id, neighbour->id, map::Decider::kPerson);
    }
  }
  if (map::find_edge(map, old_id, fresh_id) == nullptr) tidy_edges(map);
  return {};
}

Status move_images(TopologicalMap& map, const ImageId& image_a, const std::vector<ImageId>& images) {
  const Place* target = map::find_place_of(map, image_a);
  if (target == nullptr) return no_place_with(image_a);
  if (images.empty()) return fail(ErrorCode::kInvalidInput, "A move has to name the images that go.", "images");
  const PlaceId target_id = target->id;
  TopologicalMap changed = map;
  for (const ImageId& image : images) {
    Place* from = map::find_place_of(changed, image);
    if (from == nullptr) return no_place_with(image);
    if (from->id == target_id) continue;
    if (const Status taken = take_out(*from, {image}); !taken) return taken;
    map::find_place(changed, target_id)->members.push_back(image);
    for (map::Destination& destination : changed.destinations) {
      if (destination.image == image) destination.place = target_id;
    }
  }
  sort_members(changed, *map::find_place(changed, target_id));
  map = std::move(changed);
  return {};
}

Status delete_place(TopologicalMap& map, const ImageId& image) {
  const Place* place = map::find_place_of(map, image);
  if (place == nullptr) return no_place_with(image);
  const PlaceId id = place->id;
  std::erase_if(map.places, [&](const Place& p) { return p.id == id; });
  std::erase_if(map.destinations, [&](const map::Destination& d) { return d.place == id; });
  tidy_edges(map);
  return {};
}

}  // namespace homeward::mapping
