// SPDX-License-Identifier: Apache-2.0
#include "map/parts.hpp"

#include <algorithm>
#include <map>

#include "map/graph.hpp"

namespace homeward::map {

std::string tour_of(const ImageId& image) {
  const std::string& id = image.str();
  return id.substr(0, std::min(id.rfind('/'), id.size()));
}

std::vector<MapPart> parts(const TopologicalMap& map) {
  std::map<std::string, std::size_t> order;
  for (const MapImage& image : map.images) order.try_emplace(tour_of(image.id), order.size());
  const std::vector<int> component_of = components(PlaceGraph(map));
  std::vector<MapPart> result;
  for (std::size_t p = 0; p < map.places.size(); ++p) {
    const auto component = static_cast<std::size_t>(component_of[p]);
    if (component >= result.size()) result.resize(component + 1);
    MapPart& part = result[component];
    part.places.push_back(map.places[p].id);
    for (const ImageId& member : map.places[p].members) {
      std::string tour = tour_of(member);
      if (std::ranges::find(part.tours, tour) == part.tours.end()) part.tours.push_back(std::move(tour));
    }
  }
  for (MapPart& part : result) std::ranges::sort(part.tours, {}, [&](const std::string& tour) { return order[tour]; });
  return result;
}

std::string tell_parts(const std::vector<MapPart>& parts) {
  if (parts.size() < 2) return {};
  std::string text = "The map falls into " + std::to_string(parts.size()) + " parts that no way joins:\n";
  for (const MapPart& part : parts) {
    text += "  " + std::to_string(part.places.size()) + (part.places.size() == 1 ? " place (" : " places (") +
            part.places.front().str();
    if (part.places.size() > 1) text += " ... " + part.places.back().str();
    text += ")";
    for (std::size_t t = 0; t < part.tours.size(); ++t) text += (t == 0 ? " of " : ", ") + part.tours[t];
    text += "\n";
  }
  return text + "Drive a tour that passes through both of two parts, and add it to the map.\n";
}

}  // namespace homeward::map
