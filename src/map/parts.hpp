// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "map/topological_map.hpp"

namespace homeward::map {

/// Places that edges join, taken in both directions, blocked ones too.
struct MapPart {
  std::vector<PlaceId> places;     // in the order of the map
  std::vector<std::string> tours;  // with pictures at these places, each once, in the order of the map
};

/// The tour of an image "tour/file"; its whole id where it has none.
std::string tour_of(const ImageId& image);

/// The parts that a map falls into, the one with the first place first: one where every place can be reached.
std::vector<MapPart> parts(const TopologicalMap& map);

/// For people: how many parts, of which tours and places, and what to do about it. Empty where there is only one.
std::string tell_parts(const std::vector<MapPart>& parts);

}  // namespace homeward::map
