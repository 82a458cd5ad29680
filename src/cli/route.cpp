// SPDX-License-Identifier: Apache-2.0
#include "planning/route.hpp"

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "db/map_file.hpp"
#include "map/lookup.hpp"
#include "planning/no_route.hpp"
#include "wire/route_json.hpp"

namespace homeward::cli {
namespace {

struct RouteOptions {
  std::string map;
  std::string from;
  std::string to;
  std::vector<std::string> avoid;
  std::vector<std::pair<std::string, std::string>> closed;
  std::string by = "length";
  int routes = 1;
  planning::RouteRequest defaults;
  bool json = false;
};

/// A place by its id or label; the name itself where there is none, which is then refused as an unknown place.
PlaceId place_named(const map::TopologicalMap& map, const std::string& name) {
  const std::vector<PlaceId> named = map::places_named(map, name);
  return named.empty() ? PlaceId(name) : named.front();
}

planning::RouteRequest request_of(const RouteOptions& options, const map::TopologicalMap& map) {
  planning::RouteRequest request = options.defaults;
  request.from = place_named(map, options.from);
  request.to = place_named(map, options.to);
  for (const std::string& name : options.avoid) request.avoid.push_back(place_named(map, name));
  for (const auto& [from, to] : options.closed) {
    request.closed.push_back({place_named(map, from), place_named(map, to)});
  }
  request.by = options.by == "time" ? planning::RouteCost::kTime : planning::RouteCost::kLength;
  return request;
}

void print_routes(const std::vector<planning::Route>& routes) {
  std::vector<wire::RouteView> views;
  for (const planning::Route& route : routes) {
    wire::RouteView view{route.places, route.cost_m, route.length_m, route.length_from, route.time_s, {}, {}};
    for (const planning::Way& way : route.weak) view.weak.push_back({way.from, way.to});
    for (const planning::Way& way : route.shortcuts) view.shortcuts.push_back({way.from, way.to});
    views.push_back(std::move(view));
  }
  std::cout << wire::routes_to_json(views).dump() << "\n";
}

void print_text(const map::TopologicalMap& map, const std::vector<planning::Route>& routes) {
  for (std::size_t i = 0; i < routes.size(); ++i) {
    if (i > 0) std::cout << "\n";
    for (const PlaceId& id : routes[i].places) {
      const map::Place* place = map::find_place(map, id);
      std::cout << id.str() << (place->label.empty() ? "" : " " + place->label) << "\n";
    }
  }
}

Status plan(const RouteOptions& options) {
  const auto stored = db::load_map(options.map);
  if (!stored) return pass_on(stored);
  const planning::RouteRequest request = request_of(options, stored->map);
  const auto routes = planning::plan_routes(stored->map, request, options.routes);
  if (!routes) {
    if (options.json && routes.error().code == ErrorCode::kNoRoute) {
      std::cout << wire::no_route_to_json(planning::explain_no_route(stored->map, request), stored->map).dump() << "\n";
    }
    return pass_on(routes);
  }
  if (options.json) {
    print_routes(*routes);
  } else {
    print_text(stored->map, *routes);
  }
  return {};
}

}  // namespace

void register_route(CLI::App& program) {
  CLI::App* command = program.add_subcommand("route", "The way from one place of a map to another");
  const auto options = std::make_shared<RouteOptions>();
  planning::RouteRequest& request = options->defaults;
  command->add_option("--map", options->map, "Map file")->required();
  command->add_option("--from", options->from, "Place (id or label)")->required();
  command->add_option("--to", options->to, "Place (id or label)")->required();
  command->add_option("--avoid", options->avoid, "Places not to drive through");
  command->add_option("--closed", options->closed,
                      "FROM TO: a way between neighbours that is not to be driven now, in this direction (repeatable)");
  command->add_option("--by", options->by, "What the way should have little of: length or time")
      ->check(CLI::IsMember({"length", "time"}))
      ->capture_default_str();
  command->add_option("--routes", options->routes, "How many ways: the best and the next best ones")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  command
      ->add_option("--weak-factor", request.weak_edge_factor, "By length: a weak edge counts so many times its length")
      ->check(CLI::Range(1.0, 1000.0))
      ->capture_default_str();
  command->add_option("--speed", request.travel.speed_mps, "Metres a second on the way; a third of it on weak edges")
      ->check(CLI::Range(0.01, 5.0))
      ->capture_default_str();
  command->add_option("--turn-speed", request.travel.turn_radps, "Radians a second in turns from edge to edge")
      ->check(CLI::Range(0.01, 10.0))
      ->capture_default_str();
  command->add_flag("--json", options->json, "One JSON object, also where there is no way: then with the reason");
  run_on(*command, [options] { return plan(*options); });
}

}  // namespace homeward::cli
