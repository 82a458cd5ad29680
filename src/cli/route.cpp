// SPDX-License-Identifier: Apache-2.0
#include "planning/route.hpp"

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "db/map_file.hpp"
#include "map/lookup.hpp"

namespace homeward::cli {
namespace {

struct Options {
  std::string map;
  std::string from;
  std::string to;
  std::vector<std::string> avoid;
  bool json = false;
};

/// A place by its id or, where no place has this id, by the label of a destination or place.
PlaceId place_named(const map::TopologicalMap& map, const std::string& name) {
  const PlaceId id(name);
  if (map::find_place(map, id) != nullptr) return id;
  for (const map::Destination& destination : map.destinations) {
    if (destination.label == name) return destination.place;
  }
  for (const map::Place& place : map.places) {
    if (place.label == name) return place.id;
  }
  return id;
}

Status plan(const Options& options) {
  const auto stored = db::load_map(options.map);
  if (!stored) return pass_on(stored);
  planning::RouteRequest request;
  request.from = place_named(stored->map, options.from);
  request.to = place_named(stored->map, options.to);
  for (const std::string& name : options.avoid) request.avoid.push_back(place_named(stored->map, name));
  const auto route = planning::plan_route(stored->map, request);
  if (!route) return pass_on(route);
  if (options.json) {
    nlohmann::json places = nlohmann::json::array();
    for (const PlaceId& place : route->places) places.push_back(place.str());
    std::cout << nlohmann::json{{"places", places}, {"cost_m", route->cost_m}}.dump() << "\n";
    return {};
  }
  for (const PlaceId& id : route->places) {
    const map::Place* place = map::find_place(stored->map, id);
    std::cout << id.str() << (place->label.empty() ? "" : " " + place->label) << "\n";
  }
  return {};
}

}  // namespace

void register_route(CLI::App& program) {
  CLI::App* command = program.add_subcommand("route", "The way from one place of a map to another");
  const auto options = std::make_shared<Options>();
  command->add_option("--map", options->map, "Map file")->required();
  command->add_option("--from", options->from, "Place (id or label)")->required();
  command->add_option("--to", options->to, "Place (id or label)")->required();
  command->add_option("--avoid", options->avoid, "Places not to drive through");
  command->add_flag("--json", options->json, "One JSON object");
  run_on(*command, [options] { return plan(*options); });
}

}  // namespace homeward::cli
