// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <unordered_map>

#include "core/ids.hpp"
#include "map/topological_map.hpp"

namespace homeward::map {

/// The place with this id, or null. Linear in the number of places.
const Place* find_place(const TopologicalMap& map, const PlaceId& id);
Place* find_place(TopologicalMap& map, const PlaceId& id);

/// The place that holds this image, or null.
const Place* find_place_of(const TopologicalMap& map, const ImageId& image);
Place* find_place_of(TopologicalMap& map, const ImageId& image);

/// The directed edge between two places, or null.
const Edge* find_edge(const TopologicalMap& map, const PlaceId& from, const PlaceId& to);
Edge* find_edge(TopologicalMap& map, const PlaceId& from, const PlaceId& to);

/// Index into map.places of each id.
std::unordered_map<PlaceId, int> place_indices(const TopologicalMap& map);

/// Index into map.images of each id.
std::unordered_map<ImageId, int> image_indices(const TopologicalMap& map);

}  // namespace homeward::map
