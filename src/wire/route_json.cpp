// SPDX-License-Identifier: Apache-2.0
#include "wire/route_json.hpp"

#include <nlohmann/json.hpp>

#include "wire/inspect_json.hpp"
#include "wire/json_write.hpp"

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

json no_route_to_json(const std::string& reason, bool connected, const std::vector<ObstacleView>& obstacles) {
  json list = json::array();
  for (const ObstacleView& obstacle : obstacles) {
    const json from = obstacle.from ? json(obstacle.from->str()) : json(nullptr);
    list.push_back({{"kind", obstacle.kind}, {"from", from}, {"to", obstacle.to.str()}});
  }
  return {{"places", nullptr}, {"reason", reason}, {"connected", connected}, {"obstacles", std::move(list)}};
}

}  // namespace homeward::wire
