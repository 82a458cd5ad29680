// SPDX-License-Identifier: Apache-2.0
#include "wire/route_json.hpp"

#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "wire/inspect_json.hpp"
#include "wire/json_write.hpp"
#include "wire/map_reasons.hpp"
#include "wire/reason_json.hpp"

namespace homeward::wire {
namespace {

using nlohmann::json;

json ways_to_json(const std::vector<WayView>& ways) {
  json list = json::array();
  for (const WayView& way : ways) list.push_back({{"from", way.from.str()}, {"to", way.to.str()}});
  return list;
}

json route_to_json(const RouteView& route) {
  return {{"places", ids_to_json(route.places)},
          {"cost_m", route.cost_m},
          {"length_m", route.length_m},
          {"length_from", length_source_name(route.length_from)},
          {"time_s", route.time_s},
          {"weak", ways_to_json(route.weak)},
          {"shortcuts", ways_to_json(route.shortcuts)}};
}

}  // namespace

json routes_to_json(const std::vector<RouteView>& routes) {
  json value = route_to_json(routes.front());
  value["others"] = json::array();
  for (std::size_t i = 1; i < routes.size(); ++i) value["others"].push_back(route_to_json(routes[i]));
  return value;
}

json no_route_to_json(const map::NoRoute& why, const map::TopologicalMap& map) {
  constexpr std::array<std::string_view, 4> kKinds = {"blocked", "one_way", "closed", "avoided"};
  json list = json::array();
  for (const map::Obstacle& obstacle : why.obstacles) {
    const json from = obstacle.from.empty() ? json(nullptr) : json(obstacle.from.str());
    list.push_back(
        {{"kind", kKinds[static_cast<std::size_t>(obstacle.kind)]}, {"from", from}, {"to", obstacle.to.str()}});
  }
  return {{"places", nullptr},
          {"reason", reason_to_json(reason_of(why, map))},
          {"connected", why.connected},
          {"obstacles", std::move(list)}};
}

}  // namespace homeward::wire
