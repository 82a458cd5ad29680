// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/ids.hpp"
#include "map/topological_map.hpp"

namespace homeward::map {

/// The place with this id, or null. Linear in the number of places.
const Place* find_place(const TopologicalMap& map, const PlaceId& id);
Place* find_place(TopologicalMap& map, const PlaceId& id);

/// The places that a person may mean: the one with this id; else those of this label. Empty: there is none.
std::vector<PlaceId> places_named(const TopologicalMap& map, const std::string& name);

/// Those of destinations with this label, then those with this label, each once. Empty: there is none.
std::vector<PlaceId> places_labelled(const TopologicalMap& map, const std::string& label);

/// The place that holds this image, or null.
const Place* find_place_of(const TopologicalMap& map, const ImageId& image);
Place* find_place_of(TopologicalMap& map, const ImageId& image);

/// The destination with this id, or null.
const Destination* find_destination(const TopologicalMap& map, const DestinationId& id);

/// The directed edge between two places, or null.
const Edge* find_edge(const TopologicalMap& map, const PlaceId& from, const PlaceId& to);
Edge* find_edge(TopologicalMap& map, const PlaceId& from, const PlaceId& to);

/// The tour of an image "tour/file"; empty where it has none.
std::string tour_name(const ImageId& image);

/// Where an edge begins and ends: indices into map.places.
struct EdgeEnds {
  int from = 0;
  int to = 0;
};

/// The ends of an edge among these places (see place_indices); nothing where one of them is not among them.
std::optional<EdgeEnds> ends_of(const Edge& edge, const std::unordered_map<PlaceId, int>& places);

/// Index into map.places of each id.
std::unordered_map<PlaceId, int> place_indices(const TopologicalMap& map);

/// Index into map.images of each id.
std::unordered_map<ImageId, int> image_indices(const TopologicalMap& map);

}  // namespace homeward::map
