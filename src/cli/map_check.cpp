// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/map.hpp"
#include "cli/map_output.hpp"
#include "db/map_file.hpp"
#include "map/lookup.hpp"
#include "map/state.hpp"
#include "pipeline/replay_check.hpp"
#include "planning/no_route.hpp"

namespace homeward::cli {
namespace {

using pipeline::Worsening;
using pipeline::WorseSpot;

struct MapCheckOptions {
  std::string map;
  std::string before;
  std::vector<std::string> tours;
  int threads = 0;
  bool json = false;
};

constexpr std::array<const char*, 6> kKinds = {"localisation", "pictures", "places", "way", "far_way", "route"};

std::string named(const map::TopologicalMap& map, const PlaceId& id) {
  const map::Place* place = map::find_place(map, id);
  return place == nullptr ? id.str() : planning::named(*place);
}

std::string metres(double value_m) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f m", value_m);
  return text.data();
}

/// What is worse at a spot, in one sentence.
std::string words_of(const WorseSpot& spot, const map::TopologicalMap& before, const map::TopologicalMap& after) {
  const std::string some = std::to_string(spot.images.size()) + " of " + std::to_string(spot.of) + " pictures";
  switch (spot.kind) {
    case Worsening::kLocalisation:
      return "At " + named(before, spot.place) + " it would not know where it is on " + some +
             (spot.other.empty() ? "." : ", and take most of them for " + named(after, spot.other) + ".");
    case Worsening::kPictures:
      return some + " that came to " + named(after, spot.place) + " do not show it.";
    case Worsening::kPlaces:
      return "What came to " + named(after, spot.place) + " was taken " + metres(spot.distance_m) + " from it.";
    case Worsening::kWay:
      return "No picture at either end sees the way between " + named(after, spot.place) + " and " +
             named(after, spot.other) + (spot.distance_m > 0.0 ? ", " + metres(spot.distance_m) + " apart." : ".");
    case Worsening::kFarWay:
      return "The way between " + named(after, spot.place) + " and " + named(after, spot.other) + " would be " +
             metres(spot.distance_m) + " long: do they only look alike?";
    case Worsening::kRoute:
      return "No open way leads between " + named(after, spot.place) + " and " + named(after, spot.other) +
             " any more.";
  }
  return {};
}

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
  Result<pipeline::ReplayCheck> found;
  {
    ProgressBar bar;
    found = pipeline::check_by_replay(*before, stored->map, tours->sources(), options.threads,
                                      [&](const pipeline::BuildProgress& at) { bar.show(at.stage, at.share); });
  }
  if (!found) return pass_on(found);
  if (options.json) {
    nlohmann::json worse = nlohmann::json::array();
    for (const WorseSpot& spot : found->worse) {
      nlohmann::json images = nlohmann::json::array();
      for (const ImageId& image : spot.images) images.push_back(image.str());
      worse.push_back({{"kind", kKinds.at(static_cast<std::size_t>(spot.kind))},
                       {"place", spot.place.str()},
                       {"other", spot.other.empty() ? nlohmann::json(nullptr) : nlohmann::json(spot.other.str())},
                       {"images", images},
                       {"of", spot.of},
                       {"words", words_of(spot, *before, stored->map)}});
    }
    print_json({{"pictures", found->pictures},
                {"right_before", found->right_before},
                {"right_after", found->right_after},
                {"lost_before", found->lost_before},
                {"lost_after", found->lost_after},
                {"routes_before", found->routes_before},
                {"routes_after", found->routes_after},
                {"harmless", found->harmless()},
                {"worse", worse}});
  } else {
    std::cout << found->pictures << " pictures: " << found->right_before << " recognised before, " << found->right_after
              << " after; " << found->routes_before << " routes between destinations before, " << found->routes_after
              << " after\n";
    for (const WorseSpot& spot : found->worse) {
      std::cout << words_of(spot, *before, stored->map) << "\n";
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
