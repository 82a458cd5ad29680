// SPDX-License-Identifier: Apache-2.0
#include "map/lookup.hpp"

#include <algorithm>

namespace homeward::map {

const Place* find_place(const TopologicalMap& map, const PlaceId& id) {
  const auto found = std::ranges::find(map.places, id, &Place::id);
  return found == map.places.end() ? nullptr : &*found;
}

Place* find_place(TopologicalMap& map, const PlaceId& id) {
  return const_cast<Place*>(find_place(std::as_const(map), id));
}

std::vector<PlaceId> places_named(const TopologicalMap& map, const std::string& name) {
  if (find_place(map, PlaceId(name)) != nullptr) return {PlaceId(name)};
  return places_labelled(map, name);
}

std::vector<PlaceId> places_labelled(const TopologicalMap& map, const std::string& label) {
  std::vector<PlaceId> labelled;
  if (label.empty()) return labelled;  // as places are that nobody named
  const auto add = [&](const PlaceId& place) {
    if (std::ranges::find(labelled, place) == labelled.end()) labelled.push_back(place);
  };
  for (const Destination& destination : map.destinations) {
    if (destination.label == label) add(destination.place);
  }
  for (const Place& place : map.places) {
    if (place.label == label) add(place.id);
  }
  return labelled;
}

const Place* find_place_of(const TopologicalMap& map, const ImageId& image) {
  const auto found = std::ranges::find_if(
      map.places, [&](const Place& place) { return std::ranges::find(place.members, image) != place.members.end(); });
  return found == map.places.end() ? nullptr : &*found;
}

Place* find_place_of(TopologicalMap& map, const ImageId& image) {
  return const_cast<Place*>(find_place_of(std::as_const(map), image));
}

const Destination* find_destination(const TopologicalMap& map, const DestinationId& id) {
  const auto found = std::ranges::find(map.destinations, id, &Destination::id);
  return found == map.destinations.end() ? nullptr : &*found;
}

const Edge* find_edge(const TopologicalMap& map, const PlaceId& from, const PlaceId& to) {
  const auto found =
      std::ranges::find_if(map.edges, [&](const Edge& edge) { return edge.from == from && edge.to == to; });
  return found == map.edges.end() ? nullptr : &*found;
}

Edge* find_edge(TopologicalMap& map, const PlaceId& from, const PlaceId& to) {
  return const_cast<Edge*>(find_edge(std::as_const(map), from, to));
}

std::string tour_name(const ImageId& image) {
  const std::string& text = image.str();
  const std::size_t slash = text.rfind('/');
  return slash == std::string::npos ? std::string() : text.substr(0, slash);
}

std::optional<EdgeEnds> ends_of(const Edge& edge, const std::unordered_map<PlaceId, int>& places) {
  const auto from = places.find(edge.from);
  const auto to = places.find(edge.to);
  if (from == places.end() || to == places.end()) return std::nullopt;
  return EdgeEnds{from->second, to->second};
}

std::unordered_map<PlaceId, int> place_indices(const TopologicalMap& map) {
  std::unordered_map<PlaceId, int> indices;
  for (std::size_t i = 0; i < map.places.size(); ++i) indices.emplace(map.places[i].id, static_cast<int>(i));
  return indices;
}

std::unordered_map<ImageId, int> image_indices(const TopologicalMap& map) {
  std::unordered_map<ImageId, int> indices;
  for (std::size_t i = 0; i < map.images.size(); ++i) indices.emplace(map.images[i].id, static_cast<int>(i));
  return indices;
}

}  // namespace homeward::map
