// SPDX-License-Identifier: Apache-2.0
#include "mapping/edit_scene.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <system_error>

#include "map/lookup.hpp"
#include "mapping/compare_all.hpp"
#include "mapping/mapping_config.hpp"
#include "mapping/sights.hpp"

namespace homeward::mapping {
namespace {

constexpr std::uint64_t kSeed = 1;

/// What the map keeps of a picture; null where that is nothing.
map::AppearanceList::Shared kept_of(const map::TopologicalMap& map, const ImageId& image) {
  for (const map::Place& place : map.places) {
    if (place.prototype == image && !place.appearances.empty()) return place.appearances.entries().front().appearance;
    for (const auto& entry : place.appearances.entries()) {
      if (entry.image == image) return entry.appearance;
    }
  }
  for (const map::Destination& destination : map.destinations) {
    if (destination.image == image) return std::make_shared<const features::Appearance>(destination.appearance);
  }
  return nullptr;
}

map::SeenWay seen_way(const map::Place& from, const map::Place& to, const std::optional<Sight>& sight) {
  map::SeenWay way{from.prototype, to.prototype, std::nullopt, 0.0, 0.0, 0};
  if (!sight) return way;
  way.bearing_rad = sight->bearing_rad;
  way.turn_rad = sight->turn_rad;
  way.confidence = sight->confidence;
  way.inliers = sight->inliers;
  return way;
}

}  // namespace

Result<map::AppearanceList::Entry> EditScene::look_at(const ImageId& image) {
  for (const auto& entry : edit_.found.appearances.entries()) {
    if (entry.image == image) return entry;
  }
  map::AppearanceList::Entry entry{kept_of(map_, image), image};
  if (entry.appearance) return entry;
  if (!look_) {
    return fail(ErrorCode::kConflict,
                "The picture " + image.str() + " is not kept here, so that nothing could be recognised by it.",
                image.str());
  }
  auto seen = look_(image);
  if (!seen) {
    return fail(ErrorCode::kConflict, "The picture " + image.str() + " cannot be used: " + seen.error().message,
                image.str());
  }
  entry.appearance = std::make_shared<const features::Appearance>(std::move(*seen));
  edit_.found.appearances.push_back(entry);
  return entry;
}

ImageId EditScene::prototype_among(const std::vector<ImageId>& images) {
  for (const ImageId& chosen : edit_.found.prototypes) {
    if (std::ranges::find(images, chosen) != images.end()) return chosen;
  }
  edit_.found.prototypes.push_back(images[images.size() / 2]);
  return edit_.found.prototypes.back();
}

PlaceId EditScene::made_place() {
  edit_.found.made = made('p', map_.next_place_number,
                          [&](const std::string& id) { return map::find_place(map_, PlaceId(id)) == nullptr; });
  return PlaceId(edit_.found.made);
}

DestinationId EditScene::made_destination() {
  edit_.found.made = made('d', map_.next_destination_number, [&](const std::string& id) {
    return map::find_destination(map_, DestinationId(id)) == nullptr;
  });
  return DestinationId(edit_.found.made);
}

std::string EditScene::made(char letter, std::int64_t& next_number,
                            const std::function<bool(const std::string&)>& is_free) const {
  const std::string& known = edit_.found.made;
  std::int64_t number = 0;
  const bool numbered = known.size() > 1 && known.front() == letter &&
                        std::from_chars(known.data() + 1, known.data() + known.size(), number).ec == std::errc{};
  if (numbered && is_free(known)) {
    next_number = std::max(next_number, number + 1);  // the map may be one that was built before the edit
    return known;
  }
  std::string id;
  do id = letter + std::to_string(next_number++);
  while (!is_free(id));
  return id;
}

void EditScene::see(map::Edge& edge) {
  const map::Place* from = map::find_place(map_, edge.from);
  const map::Place* to = map::find_place(map_, edge.to);
  const auto known = [&](const map::SeenWay& way) { return way.from == from->prototype && way.to == to->prototype; };
  auto way = std::ranges::find_if(edit_.found.ways, known);
  if (way == edit_.found.ways.end()) {
    MutualSight mutual;
    if (!from->appearances.empty() && !to->appearances.empty()) {
      const features::Appearance& ahead = from->appearances.front();
      const features::Appearance& back = to->appearances.front();
      mutual = join_sights(relate(ahead, back, {}, kSeed), relate(back, ahead, {}, kSeed + 1));
    }
    edit_.found.ways.push_back(seen_way(*to, *from, mutual.back));
    edit_.found.ways.push_back(seen_way(*from, *to, mutual.ahead));
    way = edit_.found.ways.end() - 1;
  }
  edge.bearing_rad = way->bearing_rad;
  edge.turn_rad = way->bearing_rad ? std::optional(way->turn_rad) : std::nullopt;
  edge.confidence = way->confidence;
  edge.inliers = way->inliers;
  edge.weak = !way->bearing_rad || way->confidence < MappingConfig{}.weak_below_confidence;
}

}  // namespace homeward::mapping
