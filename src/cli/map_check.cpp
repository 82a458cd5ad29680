// SPDX-License-Identifier: Apache-2.0
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/map.hpp"
#include "cli/map_output.hpp"
#include "db/map_file.hpp"
#include "map/state.hpp"
#include "pipeline/replay_check.hpp"
#include "wire/replay_check_json.hpp"

namespace homeward::cli {
namespace {

struct MapCheckOptions {
  std::string map;
  std::string before;
  std::vector<std::string> tours;
  int threads = 0;
  bool json = false;
};

/// The map as it was: of a file, or without its people's edits.
Result<map::TopologicalMap> map_before(const MapCheckOptions& options, const map::TopologicalMap& after) {
  if (!options.before.empty()) {
    auto stored = db::load_map(options.before);
    if (!stored) return pass_on(stored);
    return std::move(stored->map);
  }
  map::TopologicalMap before = after;
  if (after.unedited) map::put_state(before, *after.unedited);
  return before;
}

Status check(const MapCheckOptions& options) {
  const auto stored = db::load_map(options.map);
  if (!stored) return pass_on(stored);
  const auto before = map_before(options, stored->map);
  if (!before) return pass_on(before);
  const auto tours = TourFolders::open(options.tours);
  if (!tours) return pass_on(tours);
  Result<map::ReplayCheck> found;
  {
    ProgressBar bar;
    found = pipeline::check_by_replay(*before, stored->map, tours->sources(), {}, options.threads,
                                      [&](const pipeline::BuildProgress& at) { bar.show(at.stage, at.share); });
  }
  if (!found) return pass_on(found);
  if (options.json) {
    print_json(wire::replay_check_to_json(*found, *before, stored->map));
  } else {
    std::cout << found->pictures << " pictures: " << found->right_before << " recognised before, " << found->right_after
              << " after; " << found->routes_before << " routes between destinations before, " << found->routes_after
              << " after\n";
    for (const map::WorseSpot& spot : found->worse) {
      std::cout << wire::worse_in_words(spot, *before, stored->map) << "\n";
      for (const ImageId& image : spot.images) std::cout << "  " << image.str() << "\n";
    }
  }
  if (found->harmless()) return {};
  const std::size_t count = found->worse.size();
  return fail(ErrorCode::kConflict,
              "The map is worse in " + std::to_string(count) + " respect" + (count == 1 ? "" : "s") + " than before.",
              options.map);
}

}  // namespace

void register_map_check(CLI::App& map) {
  CLI::App* command = map.add_subcommand(
      "check", "Try an edited map on tours: what is worse than before. Exit code 4 where something is");
  const auto options = std::make_shared<MapCheckOptions>();
  command->add_option("--map", options->map, "Map file, edited")->required();
  command->add_option("--tour", options->tours, "Folder of a tour of the map; may be given again")->required();
  command->add_option("--before", options->before, "Map file to compare with; without it the map without its edits");
  command->add_option("--threads", options->threads, "Threads (0: as many as the machine has)")
      ->check(CLI::Range(0, 256));
  command->add_flag("--json", options->json, "As one JSON object");
  run_on(*command, [options] { return check(*options); });
}

}  // namespace homeward::cli
