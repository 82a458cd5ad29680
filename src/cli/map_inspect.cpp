// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/map.hpp"
#include "db/map_file.hpp"
#include "map/parts.hpp"
#include "wire/inspect_json.hpp"

namespace homeward::cli {
namespace {

struct MapInspectOptions {
  std::string file;
  bool json = false;
};

void print_summary(const db::StoredMap& stored) {
  const map::TopologicalMap& map = stored.map;
  int accepted = 0;
  for (const map::Hypothesis& h : map.hypotheses) accepted += h.decision == map::Decision::kAccepted ? 1 : 0;
  std::size_t appearances = 0;
  for (const map::Place& place : map.places) appearances += place.appearances.size();
  int weak = 0;
  for (const map::Edge& edge : map.edges) weak += edge.weak ? 1 : 0;
  int proposed = 0;
  int driven = 0;
  for (const map::Shortcut& shortcut : map.shortcuts) {
    proposed += shortcut.state == map::ShortcutState::kProposed ? 1 : 0;
    driven += shortcut.state == map::ShortcutState::kAccepted ? 1 : 0;
  }
  std::cout << "revision      " << map.revision << "\npictures      " << map.images.size() << "\nplaces        "
            << map.places.size() << " (" << appearances << " appearances)\nedges         " << map.edges.size() << " ("
            << weak << " weak)\nloops closed  " << accepted << " of " << map.hypotheses.size()
            << " hypotheses\nshortcuts     " << driven << " accepted, " << proposed
            << " proposed (homeward map shortcuts)\nbytes         " << stored.bytes << "\n";
  for (const map::Destination& d : map.destinations) {
    std::cout << "destination   " << d.id.str() << " " << d.label << " at " << d.place.str() << "\n";
  }
  std::cout << map::tell_parts(map::parts(map));
}

Status inspect(const MapInspectOptions& options) {
  const auto stored = db::load_map(options.file);
  if (!stored) return pass_on(stored);
  if (options.json) {
    std::cout << wire::inspect_to_json(stored->map, stored->bytes).dump() << "\n";
  } else {
    print_summary(*stored);
  }
  return {};
}

}  // namespace

void register_map_inspect(CLI::App& map) {
  CLI::App* command = map.add_subcommand("inspect", "Tell what is in a map");
  const auto options = std::make_shared<MapInspectOptions>();
  command->add_option("map", options->file, "Map file")->required();
  command->add_flag("--json", options->json, "Everything, as one JSON object");
  run_on(*command, [options] { return inspect(*options); });
}

}  // namespace homeward::cli
