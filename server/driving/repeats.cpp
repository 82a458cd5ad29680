// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "map/lookup.hpp"
#include "map/taught_path.hpp"
#include "server/driving/driving.hpp"
#include "wire/lease_durations.hpp"
#include "wire/speed_limit.hpp"

namespace homeward::server {
namespace {

// The key image of a path at or before a picture of its tour.
std::size_t key_before(const map::TopologicalMap& map, const ImageId& image) {
  const auto found = std::ranges::find(map.images, image, &map::MapImage::id);
  const auto picture = static_cast<int>(found - map.images.begin());
  const auto& keys = map.path->taught.key_images;
  const auto after = std::ranges::find_if(keys, [&](const map::KeyImage& key) { return key.picture > picture; });
  return after == keys.begin() ? 0 : static_cast<std::size_t>(after - keys.begin()) - 1;
}

// The first key image that a place has.
std::size_t key_of(const map::TopologicalMap& map, const PlaceId& id) {
  const auto& images = map.path->images;
  const auto found = std::ranges::find_if(images, [&](const ImageId& image) {
    const map::Place* place = map::find_place_of(map, image);
    return place != nullptr && place->id == id;
  });
  return found == images.end() ? 0 : static_cast<std::size_t>(found - images.begin());
}

double length_m(const map::TopologicalMap& map, const std::vector<PlaceId>& path) {
  double sum_m = 0.0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const auto edge = std::ranges::find_if(
        map.edges, [&](const map::Edge& one) { return one.from == path[i] && one.to == path[i + 1]; });
    if (edge != map.edges.end()) sum_m += edge->length_m;
  }
  return sum_m;
}

}  // namespace

void Driving::plan_repeat(const map::TopologicalMap& map, const PlaceId& start, const ImageId& end, Plan& plan) {
  const map::TaughtPath& taught = map.path->taught;
  const std::size_t last = key_before(map, end);
  std::size_t first = key_of(map, start);
  const bool goes_round = taught.closing && taught.closing->key_image <= static_cast<int>(last);
  if (first > last && !goes_round) first = last;
  for (std::size_t key = first;; ++key) {
    // Round a closed path.
    if (key == taught.key_images.size()) key = static_cast<std::size_t>(taught.closing->key_image);
    const map::Place* place = map::find_place_of(map, map.path->images[key]);
    // A place may have several key images, once somebody has merged places.
    if (place != nullptr && (plan.mission.path.empty() || plan.mission.path.back() != place->id))
      plan.mission.path.push_back(place->id);
    if (key == last) break;
  }
  plan.length_m = length_m(map, plan.mission.path);
  wire::RepeatOrder& order = plan.repeat.emplace();
  order.label = plan.mission.destination ? map::find_destination(map, *plan.mission.destination)->label : "";
  order.image = end;
  plan.first_arc = taught.arc_from(static_cast<int>(first)).value_or(0);
}

void Driving::send_repeat(RobotUnit& unit, Plan& plan, const wire::Order& number) {
  wire::RepeatOrder& order = *plan.repeat;
  order.mission = plan.mission.id;
  order.order = number;
  order.map = plan.mission.map;
  order.revision = plan.mission.revision;
  order.valid_for_ms = wire::kPermitValid_ms;
  order.speed_limit_mps = std::min(wire::kSpeedLimit_mps, unit.hello.max_speed_mps);
  unit.first_arc = plan.first_arc;
  unit.link->send(order);
}

}  // namespace homeward::server
