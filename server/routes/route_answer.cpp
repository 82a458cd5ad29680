// SPDX-License-Identifier: Apache-2.0
#include "server/routes/route_answer.hpp"

#include <charconv>
#include <sstream>

#include "planning/route.hpp"
#include "server/http/json_body.hpp"
#include "wire/route_json.hpp"

namespace homeward::server {
namespace {

constexpr int kMostRoutes = 10;

struct Asked {
  planning::RouteRequest route;
  int count = 1;
};

Result<Asked> asked_in(const Request& request) {
  const auto value = [&](const char* name) {
    const auto found = request.query.find(name);
    return found == request.query.end() ? nullptr : &found->second;
  };
  const std::string* from = value("from");
  const std::string* to = value("to");
  if (from == nullptr || to == nullptr) {
    return fail(ErrorCode::kInvalidInput, "A route needs from=PLACE and to=PLACE.", "query");
  }
  Asked asked;
  asked.route.from = PlaceId(*from);
  asked.route.to = PlaceId(*to);
  if (const std::string* avoid = value("avoid")) {
    std::istringstream names(*avoid);
    for (std::string name; std::getline(names, name, ',');) {
      if (!name.empty()) asked.route.avoid.emplace_back(name);
    }
  }
  if (const std::string* by = value("by")) {
    if (*by != "length" && *by != "time") {
      return fail(ErrorCode::kInvalidInput, "A route is planned by length or by time.", "query/by");
    }
    if (*by == "time") asked.route.by = planning::RouteCost::kTime;
  }
  if (const std::string* routes = value("routes")) {
    const char* last = routes->data() + routes->size();
    const auto [end, trouble] = std::from_chars(routes->data(), last, asked.count);
    if (trouble != std::errc{} || end != last || asked.count < 1 || asked.count > kMostRoutes) {
      return fail(ErrorCode::kInvalidInput, "Between 1 and 10 routes can be asked for.", "query/routes");
    }
  }
  return asked;
}

}  // namespace

Response answer_route(MapService& maps, const MapId& map, const Request& request) {
  const auto asked = asked_in(request);
  if (!asked) return problem_of(asked);
  const auto loaded = maps.load(map);
  if (!loaded) return problem_of(loaded);
  const auto found = planning::plan_routes((*loaded)->map, asked->route, asked->count);
  if (!found) return problem_of(found);
  std::vector<wire::RouteView> views;
  for (const planning::Route& route : *found) {
    wire::RouteView view{route.places, route.cost_m, route.length_m, route.length_from, route.time_s, {}, {}};
    for (const planning::Way& way : route.weak) view.weak.push_back({way.from, way.to});
    for (const planning::Way& way : route.shortcuts) view.shortcuts.push_back({way.from, way.to});
    views.push_back(std::move(view));
  }
  return json_response(200, wire::routes_to_json(views));
}

}  // namespace homeward::server
